#include "thing_kin/rmma/base_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

namespace thing_kin {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

enum Entry : std::uint8_t {
  kX,
  kY,
  kTheta,
  kSpeed,
  kCurvature,
  kBiasX,
  kBiasY,
  kBiasTheta,
  kCreep
};

constexpr double kDegree = std::numbers::pi / 180.0;

// What is not known when a side begins.
constexpr double kFarAway = 0.05;  // m: before the registration was heard of
constexpr double kHeading = 1.0 * kDegree;
constexpr double kSpeedShare = 0.03;
constexpr double kCurvatureDeviation = 1.0 * kDegree;  // rad/m
constexpr double kCreepSpeed = 0.0002;                 // m/s
constexpr double kStartLag = 0.4;                      // s
constexpr double kBias = 0.008;                        // m, of the odometry
constexpr double kHeadingBias = 0.2 * kDegree;
// What is lost on the way, per square root of a metre.
constexpr double kPositionWalk = 0.004;  // m
constexpr double kHeadingWalk = 0.6 * kDegree;
constexpr double kSpeedWalk = 0.04;
constexpr double kCreepWalk = 0.001;  // of its variance, per s
// Readings.
constexpr double kOdometryWhite = 0.002;  // m
constexpr double kOdometryHeading = 0.5 * kDegree;
constexpr double kArmDeviation = 0.001;  // m: what forward kinematics does not see
constexpr double kLongestStep = 0.05;    // m: the way is taken as straight so far
constexpr double kMostSteps = 1e6;
constexpr double kSlowestShare = 0.3;  // of v_b
// A reading that is this improbable was a jump, of the base or of its localization.
constexpr double kJumpNis = 25.0;
constexpr double kJumpOfBase = 0.008;     // m
constexpr double kJumpOfBias = 0.016;     // m
constexpr double kJumpOfHeading = 0.015;  // rad, each
constexpr double kJumpLogProbability = -6.0;
// Weights never leave a guess for good: noise may change.
constexpr double kLeastLogWeight = -12.0;
constexpr double kLeastWeight = 0.003;  // of a guess that a search heeds

using OdometrySight = Eigen::Matrix<double, 3, BaseEstimator::kStates>;

double squared(double x) { return x * x; }

StateMatrix first_covariance(const NoiseGuess& scale) {
  StateMatrix P = StateMatrix::Zero(BaseEstimator::kStates, BaseEstimator::kStates);
  P(kX, kX) = P(kY, kY) = squared(kFarAway);
  P(kTheta, kTheta) = squared(kHeading * scale.drift);
  P(kSpeed, kSpeed) = squared(kSpeedShare * scale.drift);
  P(kCurvature, kCurvature) = squared(kCurvatureDeviation * scale.drift);
  P(kBiasX, kBiasX) = P(kBiasY, kBiasY) = squared(kBias * scale.odometry);
  P(kBiasTheta, kBiasTheta) = squared(kHeadingBias * scale.odometry);
  P(kCreep, kCreep) = squared(kCreepSpeed * scale.drift);
  return P;
}

/// The tool at a displacement u from the base, p + R(theta) u, and its derivative.
struct ToolSight {
  ToolSight(const StateVector& x, const Vector2d& u) {
    const double c = std::cos(x(kTheta));
    const double s = std::sin(x(kTheta));
    const Vector2d turned(c * u.x() - s * u.y(), s * u.x() + c * u.y());
    at = x.head<2>() + turned;
    H(0, kX) = H(1, kY) = 1.0;
    H(0, kTheta) = -turned.y();
    H(1, kTheta) = turned.x();
  }

  Vector2d at;
  Eigen::Matrix<double, 2, BaseEstimator::kStates> H =
      Eigen::Matrix<double, 2, BaseEstimator::kStates>::Zero();
};

/// Where a reading can't be, the state before it is taken to have jumped: whether it did.
bool jumped(ExtendedKalmanFilter& filter, const Eigen::Vector3d& innovation, const OdometrySight& H,
            const Eigen::Matrix3d& R) {
  StateMatrix P = filter.P();
  const Eigen::Matrix3d S =
      H * P.topLeftCorner<BaseEstimator::kStates, BaseEstimator::kStates>() * H.transpose() + R;
  if (innovation.dot(S.inverse() * innovation) < kJumpNis) {
    return false;
  }
  P(kX, kX) += squared(kJumpOfBase);
  P(kY, kY) += squared(kJumpOfBase);
  P(kBiasX, kBiasX) += squared(kJumpOfBias);
  P(kBiasY, kBiasY) += squared(kJumpOfBias);
  P(kTheta, kTheta) += squared(kJumpOfHeading);
  P(kBiasTheta, kBiasTheta) += squared(kJumpOfHeading);
  filter.set_P(P);
  return true;
}

}  // namespace

BaseEstimator::BaseEstimator(const Vector2d& fiducial, const Vector2d& displacement,
                             double velocity, double radius, NoiseMemory& memory)
    : velocity_(velocity), memory_(&memory) {
  State x = State::Zero();
  x.head<2>() = fiducial - displacement;
  for (const NoiseGuess& scale : kNoiseGuesses) {
    bank_.emplace_back(x, first_covariance(scale));
  }
  PlanarNormal miss;
  miss.covariance = squared(0.5 * radius) * Matrix2d::Identity();
  settle();
  hit(fiducial, displacement, miss);
  for (ExtendedKalmanFilter& filter : bank_) {
    StateMatrix P = filter.P();
    P(kX, kX) += squared(kStartLag * velocity);
    filter.set_P(P);
  }
}

void BaseEstimator::predict(double dt) {
  const double distance = velocity_ * dt;
  if (!(distance > 0.0)) {
    return;
  }
  const int steps = static_cast<int>(std::ceil(std::min(distance / kLongestStep, kMostSteps)));
  for (int step = 0; step < steps; ++step) {
    for (std::size_t k = 0; k < bank_.size(); ++k) {
      predict_member(k, dt / steps, distance / steps);
    }
  }
  settle();
}

void BaseEstimator::predict_member(std::size_t k, double dt, double distance) {
  ExtendedKalmanFilter& filter = bank_[k];
  const NoiseGuess& scale = kNoiseGuesses[k];
  StateVector x = filter.x();
  const double c = std::cos(x(kTheta));
  const double s = std::sin(x(kTheta));
  const double way = distance * (1.0 + x(kSpeed));
  const double kept = std::exp(-distance / scale.bias_length);
  ModelMatrix F = ModelMatrix::Identity(kStates, kStates);
  F(kX, kTheta) = -way * s;
  F(kX, kSpeed) = distance * c;
  F(kY, kTheta) = way * c;
  F(kY, kSpeed) = distance * s;
  F(kY, kCreep) = dt;
  F(kTheta, kCurvature) = distance;
  F(kBiasX, kBiasX) = F(kBiasY, kBiasY) = F(kBiasTheta, kBiasTheta) = kept;
  x(kX) += way * c;
  x(kY) += way * s + x(kCreep) * dt;
  x(kTheta) += distance * x(kCurvature);
  x(kBiasX) *= kept;
  x(kBiasY) *= kept;
  x(kBiasTheta) *= kept;
  const double fresh = 1.0 - kept * kept;
  StateMatrix Q = StateMatrix::Zero(kStates, kStates);
  Q(kX, kX) = Q(kY, kY) = squared(kPositionWalk * scale.drift) * distance;
  Q(kTheta, kTheta) = squared(kHeadingWalk * scale.drift) * distance;
  Q(kSpeed, kSpeed) = squared(kSpeedWalk * scale.drift) * distance;
  Q(kBiasX, kBiasX) = Q(kBiasY, kBiasY) = squared(kBias * scale.odometry) * fresh;
  Q(kBiasTheta, kBiasTheta) = squared(kHeadingBias * scale.odometry) * fresh;
  Q(kCreep, kCreep) = squared(kCreepSpeed * scale.drift) * kCreepWalk * dt;
  filter.predict(x, F, Q);
}

void BaseEstimator::read_odometry(const Pose2& seen) {
  OdometrySight H = OdometrySight::Zero();
  for (int i = 0; i < 3; ++i) {
    H(i, i) = H(i, kBiasX + i) = 1.0;
  }
  for (std::size_t k = 0; k < bank_.size(); ++k) {
    const double scale = kNoiseGuesses[k].odometry;
    ExtendedKalmanFilter& filter = bank_[k];
    const StateVector expected = H * filter.x();
    const Eigen::Vector3d variance(squared(kOdometryWhite * scale), squared(kOdometryWhite * scale),
                                   squared(kOdometryHeading * scale));
    StateVector z = seen;
    z(2) = expected(2) + wrap_angle(seen.z() - expected(2));
    const Eigen::Matrix3d R = variance.asDiagonal();
    if (jumped(filter, z - expected, H, R)) {
      memory_->log_weight[k] += kJumpLogProbability;
    }
    filter.update(z, expected, H, R);
    weigh(k);
  }
  settle();
}

void BaseEstimator::hit(const Vector2d& fiducial, const Vector2d& displacement,
                        const PlanarNormal& miss) {
  for (std::size_t k = 0; k < bank_.size(); ++k) {
    ExtendedKalmanFilter& filter = bank_[k];
    const ToolSight tool(filter.x(), displacement);
    const Matrix2d R = miss.covariance + (squared(kArmDeviation) + squared(kNoiseGuesses[k].map)) *
                                             Matrix2d::Identity();
    filter.update(fiducial - miss.mean, tool.at, tool.H, R);
    weigh(k);
  }
  settle();
}

void BaseEstimator::weigh(std::size_t k) {
  memory_->log_weight[k] += bank_[k].last().log_likelihood();
}

void BaseEstimator::settle() {
  auto& logs = memory_->log_weight;
  const double most = *std::ranges::max_element(logs);
  double sum = 0.0;
  for (std::size_t k = 0; k < logs.size(); ++k) {
    logs[k] = std::max(logs[k] - most, kLeastLogWeight);
    weight_[k] = std::exp(logs[k]);
    sum += weight_[k];
  }
  pose_.setZero();
  speed_share_ = 0.0;
  for (std::size_t k = 0; k < logs.size(); ++k) {
    weight_[k] /= sum;
    pose_ += weight_[k] * bank_[k].x().head<3>();
    speed_share_ += weight_[k] * bank_[k].x()(kSpeed);
  }
}

double BaseEstimator::speed() const noexcept {
  return velocity_ * std::max(kSlowestShare, (1.0 + speed_share_) * std::cos(pose_.z()));
}

std::vector<PlanarNormal> BaseEstimator::offsets(const Vector2d& displacement) const {
  const Vector2d meant = compose(pose_, Pose2(displacement.x(), displacement.y(), 0.0)).head<2>();
  std::vector<PlanarNormal> parts;
  for (std::size_t k = 0; k < bank_.size(); ++k) {
    if (weight_[k] < kLeastWeight) {
      continue;
    }
    const ToolSight tool(bank_[k].x(), displacement);
    PlanarNormal part;
    part.weight = weight_[k];
    part.mean = meant - tool.at;
    part.covariance = tool.H * bank_[k].P().topLeftCorner<kStates, kStates>() * tool.H.transpose();
    part.covariance +=
        (squared(kArmDeviation) + squared(kNoiseGuesses[k].map)) * Matrix2d::Identity();
    parts.push_back(part);
  }
  return parts;
}

Matrix2d BaseEstimator::covariance() const {
  Matrix2d covariance = Matrix2d::Zero();
  for (std::size_t k = 0; k < bank_.size(); ++k) {
    const Vector2d d = bank_[k].x().head<2>() - pose_.head<2>();
    covariance += weight_[k] * (bank_[k].P().topLeftCorner<2, 2>() + d * d.transpose());
  }
  return covariance;
}

}  // namespace thing_kin
