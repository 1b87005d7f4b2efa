#include "thing_kin/rmma/base_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "thing_kin/core/random.hpp"

namespace thing_kin {
namespace {

using Eigen::Vector2d;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRadius = 0.012;
const Vector2d kDisplacement(0.2, 0.6);

/// What a drive of one metre left behind.
struct Drive {
  double nees = 0.0;  // of (x, y)
  double error = 0.0;
  NoiseMemory memory;
};

/// A base that drifts as the estimator thinks, and a localization that errs `scale` times as much.
Drive drive(std::uint64_t key, double scale, double jump = 0.0) {
  RandomStream random(key);
  const double velocity = 0.02;
  const double step = 0.02;
  Pose2 truth(0.0, 0.0, 1.0 * kDegree * random.normal());
  const double share = 0.03 * random.normal();
  const double curvature = 1.0 * kDegree * random.normal();
  Vector2d bias = 0.008 * scale * Vector2d(random.normal(), random.normal());
  const Vector2d tool = compose(truth, Pose2(0.2, 0.6, 0.0)).head<2>();
  const Vector2d miss = 0.5 * kRadius * Vector2d(random.normal(), random.normal());
  Drive result;
  BaseEstimator base(tool + miss, kDisplacement, velocity, kRadius, result.memory);
  const double kept = std::exp(-step / 0.4);
  for (int i = 0; i < 50; ++i) {
    truth.z() += curvature * step + 0.6 * kDegree * std::sqrt(step) * random.normal();
    truth.x() += step * (1.0 + share) * std::cos(truth.z());
    truth.y() += step * (1.0 + share) * std::sin(truth.z());
    bias = kept * bias + 0.008 * scale * std::sqrt(1.0 - kept * kept) *
                             Vector2d(random.normal(), random.normal());
    Pose2 seen = truth;
    seen.head<2>() += bias + 0.002 * scale * Vector2d(random.normal(), random.normal());
    seen.z() += 0.5 * kDegree * scale * random.normal();
    if (i >= 25) {
      seen.x() += jump;
    }
    base.predict(step / velocity);
    base.read_odometry(seen);
  }
  const Vector2d error = (truth - base.pose()).head<2>();
  result.error = error.norm();
  result.nees = error.dot(base.covariance().inverse() * error);
  return result;
}

double mean_nees(double scale) {
  double sum = 0.0;
  for (std::uint64_t key = 0; key < 200; ++key) {
    sum += drive(key, scale).nees;
  }
  return sum / 200.0;
}

TEST(BaseEstimator, CovarianceIsThatOfItsErrors) {
  // Two degrees of freedom; the mean of 200 has a deviation of 0.14. It is allowed to be careful.
  EXPECT_GT(mean_nees(1.0), 0.8);
  EXPECT_LT(mean_nees(1.0), 2.5);
  EXPECT_LT(mean_nees(2.0), 2.8);
  EXPECT_LT(mean_nees(4.0), 3.0);
}

TEST(BaseEstimator, LearnsHowGoodTheOdometryIs) {
  for (const auto& [scale, lowest, highest] :
       {std::array{1.0, 0.0, 1.5}, std::array{4.0, 2.0, 4.0}}) {
    int right = 0;
    for (std::uint64_t key = 0; key < 50; ++key) {
      const NoiseMemory memory = drive(key, scale).memory;
      const auto best = std::ranges::max_element(memory.log_weight);
      const auto guess = kNoiseGuesses[static_cast<std::size_t>(best - memory.log_weight.begin())];
      right += guess.odometry >= lowest && guess.odometry <= highest ? 1 : 0;
    }
    EXPECT_GE(right, 45) << scale;
  }
}

TEST(BaseEstimator, JumpsOfTheOdometryAreNotTheBases) {
  double error = 0.0;
  for (std::uint64_t key = 0; key < 50; ++key) {
    error += drive(key, 0.5, 0.05).error / 50.0;
  }
  EXPECT_LT(error, 0.02);  // of a jump of 50 mm
}

TEST(BaseEstimator, AHitTellsWhereTheToolWas) {
  NoiseMemory memory;
  BaseEstimator base(Vector2d(0.2, 0.6), kDisplacement, 0.02, kRadius, memory);
  base.predict(20.0);
  const double before = base.covariance().trace();
  const Vector2d fiducial(0.62, 0.61);  // 20 mm ahead of where the base should be, 10 aside
  PlanarNormal miss;
  miss.covariance = 1e-6 * Eigen::Matrix2d::Identity();
  base.hit(fiducial, kDisplacement, miss);
  EXPECT_LT(base.covariance().trace(), 0.5 * before);
  const Vector2d tool =
      compose(base.pose(), Pose2(kDisplacement.x(), kDisplacement.y(), 0.0)).head<2>();
  EXPECT_LT((tool - fiducial).norm(), 0.003);
  EXPECT_GT(base.speed(), 0.02);  // it came farther than v_b brings it
  // The offsets are then about zero, and narrow.
  for (const PlanarNormal& part : base.offsets(kDisplacement)) {
    EXPECT_LT(part.mean.norm(), 0.01);
  }
}

TEST(BaseEstimator, AHitAsideTellsTheHeading) {
  for (const double aside : {0.01, -0.01}) {
    NoiseMemory memory;
    BaseEstimator base(Vector2d(0.2, 0.6), kDisplacement, 0.02, kRadius, memory);
    base.predict(50.0);
    PlanarNormal miss;
    miss.covariance = 1e-6 * Eigen::Matrix2d::Identity();
    base.hit(Vector2d(1.2, 0.6 + aside), kDisplacement, miss);
    // It drove a metre: had it only been turned from the start, by aside/1 m.
    EXPECT_GT(base.pose().z() / aside, 0.3);
    EXPECT_LT(base.pose().z() / aside, 3.0);
  }
}

TEST(BaseEstimator, OffsetsAreTheirWeightsMean) {
  NoiseMemory memory;
  BaseEstimator base(Vector2d(0.2, 0.6), kDisplacement, 0.02, kRadius, memory);
  base.predict(30.0);
  Vector2d mean = Vector2d::Zero();
  double weight = 0.0;
  for (const PlanarNormal& part : base.offsets(kDisplacement)) {
    mean += part.weight * part.mean;
    weight += part.weight;
    EXPECT_GT(part.covariance.determinant(), 0.0);
  }
  EXPECT_NEAR(weight, 1.0, 0.03);  // the least are left out
  EXPECT_LT(mean.norm(), 1e-3);
}

}  // namespace
}  // namespace thing_kin
