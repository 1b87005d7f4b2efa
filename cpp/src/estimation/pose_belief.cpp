#include "thing_kin/estimation/pose_belief.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/spd.hpp"
#include "thing_kin/odometry/planar_motion.hpp"

namespace thing_kin {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using JointMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                  kMaxBeliefSize, kMaxBeliefSize>;
using JointVectorOfBelief =
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxBeliefSize, 1>;

// What a heading does to a displacement d (world axes): the rows of F that are not the identity's.
Matrix3d carried(const Vector2d& d) {
  Matrix3d F = Matrix3d::Identity();
  F(0, 2) = -d.y();
  F(1, 2) = d.x();
  return F;
}

// int F(s) N F(s)^T ds over the stretch by Simpson's rule, which is exact on a straight line:
// noise at s moves the pose and turns what is left of the way.
Matrix3d accumulated(const Matrix3d& noise, const Vector2d& whole, const Vector2d& second_half) {
  const Matrix3d F = carried(whole);
  const Matrix3d H = carried(second_half);
  return (F * noise * F.transpose() + 4.0 * (H * noise * H.transpose()) + noise) / 6.0;
}

// The unscented transform of n sigma points at sqrt(n) standard deviations, equal weights
// (alpha = 1, beta = kappa = 0), with the heading first in the factor: all but two points lie where
// the function is linear. `even` is the mean of those two less the center.
Vector2d unscented_shift(const Vector2d& even, double n) { return even / n; }

Matrix3d unscented_excess(const Vector2d& even, double n) {
  Matrix3d excess = Matrix3d::Zero();
  excess.topLeftCorner<2, 2>() = ((n - 1.0) / (n * n)) * (even * even.transpose());
  return excess;
}

// The variances of A P A^T if nothing cancelled.
template <typename Rows, typename Square>
auto sizes_of(const Rows& A, const Square& P) {
  return (A.cwiseAbs() * P.cwiseAbs() * A.cwiseAbs().transpose()).diagonal().eval();
}

// Rows that do not count: no expectation, no innovation, a variance of one by itself.
Matrix3d counted(Matrix3d R, std::uint8_t rows) {
  for (int k = 0; k < 3; ++k) {
    if ((rows >> k & 1U) == 0) {
      R.row(k).setZero();
      R.col(k).setZero();
      R(k, k) = 1.0;
    }
  }
  return R;
}

// Joseph's form: x += K r, P = (1 - K H) P (1 - K H)^T + K R K^T, gated.
template <typename Joint, typename Rows, typename State>
PoseVerdict correct(Joint& P, Rows H, Vector3d r, const Matrix3d& R, const PoseMeasurement& m,
                    State& change) {
  for (int k = 0; k < 3; ++k) {
    if ((m.rows >> k & 1U) == 0) {
      H.row(k).setZero();
      r[k] = 0.0;
    }
  }
  const Matrix3d R_counted = counted(R, m.rows);
  const Rows HP = H * P;
  Matrix3d S = HP * H.transpose() + R_counted;
  S = (0.5 * (S + S.transpose())).eval();
  const Eigen::LLT<Matrix3d> factor(S);
  PoseVerdict verdict;
  verdict.dof = std::popcount(m.rows);
  verdict.nis = r.dot(factor.solve(r));
  verdict.accepted =
      factor.info() == Eigen::Success && std::isfinite(verdict.nis) && verdict.nis <= m.gate;
  if (!verdict.accepted) {
    return verdict;
  }
  const Rows Kt = factor.solve(HP);
  Joint I_KH = -Kt.transpose() * H;
  I_KH.diagonal().array() += 1.0;
  change.noalias() = Kt.transpose() * r;
  const Joint half = I_KH * P;
  const Joint before = P;
  P.noalias() = half * I_KH.transpose();
  P += Kt.transpose() * (R_counted * Kt);
  P = (0.5 * (P + P.transpose())).eval();
  for (Eigen::Index k = 0; k < P.rows(); k += 3) {
    Matrix3d block = P.template block<3, 3>(k, k);
    if (!is_positive(block)) {
      const Vector3d sizes =
          (sizes_of(I_KH, before) + sizes_of(Kt.transpose(), R_counted)).template segment<3>(k);
      keep_positive(block, sizes);
      P.template block<3, 3>(k, k) = block;
    }
  }
  return verdict;
}

}  // namespace

PoseBelief::PoseBelief(const Pose2& pose, Matrix3d P) : pose_(pose), P_(std::move(P)) {
  pose_.z() = wrap_angle(pose.z());
}

void PoseBelief::predict(const PlanarStep& step, PoseFilter filter) noexcept {
  const Pose2 end = compose(pose_, se2_exp(step.xi));
  const Pose2 middle = compose(pose_, se2_exp(0.5 * step.xi));
  const Vector2d moved = end.head<2>() - pose_.head<2>();
  const MotionJacobians by = motion_jacobians(pose_, step.xi);
  Matrix3d F = by.by_pose;
  Matrix3d excess = Matrix3d::Zero();
  Vector2d shift = Vector2d::Zero();
  if (filter == PoseFilter::kUnscented && P_(2, 2) > 0.0) {
    const double angle = std::sqrt(3.0 * P_(2, 2));
    F.col(2).head<2>() *= std::sin(angle) / angle;
    const double half = std::sin(0.5 * angle);
    const Vector2d even = -2.0 * half * half * moved;
    shift = unscented_shift(even, 3.0);
    excess = unscented_excess(even, 3.0);
  }
  const Matrix3d& G = by.by_motion;
  const Matrix3d sum = F * P_ * F.transpose() + G * step.covariance * G.transpose() + excess +
                       accumulated(step.noise, moved, end.head<2>() - middle.head<2>());
  const Matrix3d before = P_;
  P_ = 0.5 * (sum + sum.transpose());
  if (!is_positive(P_)) {
    const Vector3d sizes = sizes_of(F, before) + sizes_of(G, step.covariance) + excess.diagonal() +
                           sizes_of(carried(moved), step.noise);
    keep_positive(P_, sizes);
  }
  pose_ = end;
  pose_.head<2>() += shift;
  for (Eigen::Index k = 0; k < cross_.cols(); k += 3) {
    cross_.middleCols<3>(k) = (F * cross_.middleCols<3>(k)).eval();
  }
}

PoseVerdict PoseBelief::update(const PoseMeasurement& measured) noexcept {
  const Vector3d r = pose_difference(measured.z, pose_);
  if (clones_.empty()) {
    Vector3d change;
    const PoseVerdict verdict =
        correct(P_, Matrix3d(Matrix3d::Identity()), r, measured.R, measured, change);
    if (verdict.accepted) {
      pose_ += change;
      pose_.z() = wrap_angle(pose_.z());
    }
    return verdict;
  }
  Rows H = Rows::Zero(3, 3 + P_clones_.cols());
  H.leftCols<3>().setIdentity();
  return update_joint(H, r, measured.R, measured);
}

PoseVerdict PoseBelief::update_relative(std::uint64_t id, const PoseMeasurement& measured,
                                        PoseFilter filter) noexcept {
  const int k = find(id);
  if (k < 0) {
    return {};
  }
  const Pose2& past = clones_[static_cast<std::size_t>(k)].pose;
  Pose2 expected = between(past, pose_);
  const double c = std::cos(past.z());
  const double s = std::sin(past.z());
  Eigen::Matrix2d back;
  back << c, s, -s, c;
  Rows H = Rows::Zero(3, 3 + P_clones_.cols());
  auto of_past = H.middleCols<3>(3 + 3 * k);
  H.leftCols<3>().setIdentity();
  H.topLeftCorner<2, 2>() = back;
  of_past.topLeftCorner<2, 2>() = -back;
  of_past.col(2) << expected.y(), -expected.x(), -1.0;
  Matrix3d R = measured.R;
  const double variance = P_clones_(3 * k + 2, 3 * k + 2);
  if (filter == PoseFilter::kUnscented && variance > 0.0) {
    // Two points at sqrt(6) standard deviations of the past heading; the way between goes along.
    const Vector2d lean =
        cross_.col(3 * k + 2).head<2>() - P_clones_.col(3 * k + 2).segment<2>(3 * k);
    const double angle = std::sqrt(6.0 * variance);
    const Vector2d side = back * lean * (angle / variance);
    const auto seen = [&](double sign) {
      const double ca = std::cos(angle);
      const double sa = sign * std::sin(angle);
      const Vector2d d = expected.head<2>() + sign * side;
      return Vector2d(ca * d.x() + sa * d.y(), ca * d.y() - sa * d.x());
    };
    const Vector2d plus = seen(1.0);
    const Vector2d minus = seen(-1.0);
    of_past.col(2).head<2>() = (0.5 * (plus - minus) - side) / angle;
    const Vector2d even = 0.5 * (plus + minus) - expected.head<2>();
    expected.head<2>() += unscented_shift(even, 6.0);
    R += unscented_excess(even, 6.0);
  }
  return update_joint(H, pose_difference(measured.z, expected), R, measured);
}

PoseVerdict PoseBelief::update_joint(const Rows& H, const Vector3d& r, const Matrix3d& R,
                                     const PoseMeasurement& measured) noexcept {
  const Eigen::Index n = P_clones_.cols();
  JointMatrix P(3 + n, 3 + n);
  P.topLeftCorner<3, 3>() = P_;
  P.topRightCorner(3, n) = cross_;
  P.bottomLeftCorner(n, 3) = cross_.transpose();
  P.bottomRightCorner(n, n) = P_clones_;
  JointVectorOfBelief change(3 + n);
  const PoseVerdict verdict = correct(P, H, r, R, measured, change);
  if (!verdict.accepted) {
    return verdict;
  }
  P_ = P.topLeftCorner<3, 3>();
  cross_ = P.topRightCorner(3, n);
  P_clones_ = P.bottomRightCorner(n, n);
  const auto moved = [&](Pose2& pose, Eigen::Index row) {
    pose += change.segment<3>(row);
    pose.z() = wrap_angle(pose.z());
  };
  moved(pose_, 0);
  for (std::size_t k = 0; k < clones_.size(); ++k) {
    moved(clones_[k].pose, 3 + 3 * static_cast<Eigen::Index>(k));
  }
  return verdict;
}

bool PoseBelief::clone(std::uint64_t id) {
  if (clones_.size() == static_cast<std::size_t>(kMaxClones)) {
    return false;
  }
  const Eigen::Index n = P_clones_.cols();
  P_clones_.conservativeResize(n + 3, n + 3);
  P_clones_.topRightCorner(n, 3) = cross_.transpose();
  P_clones_.bottomLeftCorner(3, n) = cross_;
  P_clones_.bottomRightCorner<3, 3>() = P_;
  cross_.conservativeResize(3, n + 3);
  cross_.rightCols<3>() = P_;
  clones_.push_back({id, pose_});
  return true;
}

void PoseBelief::forget(std::uint64_t id) noexcept {
  const int k = find(id);
  if (k < 0) {
    return;
  }
  const Eigen::Index after = P_clones_.cols() - 3 * k - 3;
  const Eigen::Index first = 3 * k;
  P_clones_.middleCols(first, after) = P_clones_.rightCols(after).eval();
  P_clones_.middleRows(first, after) = P_clones_.bottomRows(after).eval();
  cross_.middleCols(first, after) = cross_.rightCols(after).eval();
  P_clones_.conservativeResize(first + after, first + after);
  cross_.conservativeResize(3, first + after);
  clones_.erase(clones_.begin() + k);
}

int PoseBelief::find(std::uint64_t id) const noexcept {
  const auto found = std::ranges::find(clones_, id, &Clone::id);
  return found == clones_.end() ? -1 : static_cast<int>(found - clones_.begin());
}

std::vector<double> PoseBelief::numbers() const {
  std::vector<double> out(pose_.data(), pose_.data() + 3);
  out.insert(out.end(), P_.data(), P_.data() + 9);
  for (const Clone& clone : clones_) {
    out.push_back(static_cast<double>(clone.id));  // counts, far below 2^53
    out.insert(out.end(), clone.pose.data(), clone.pose.data() + 3);
  }
  out.insert(out.end(), cross_.data(), cross_.data() + cross_.size());
  out.insert(out.end(), P_clones_.data(), P_clones_.data() + P_clones_.size());
  return out;
}

PoseBelief PoseBelief::from_numbers(const std::vector<double>& numbers) {
  Eigen::Index clones = 0;  // 12 + 4 k + 9 k + 9 k^2 numbers
  const auto size = [](Eigen::Index k) {
    return static_cast<std::size_t>(12 + 13 * k + 9 * k * k);
  };
  while (clones <= kMaxClones && size(clones) != numbers.size()) {
    ++clones;
  }
  if (clones > kMaxClones) {
    throw InvalidArgument("state", std::to_string(numbers.size()) + " numbers", "those of a pose");
  }
  const double* at = numbers.data();
  PoseBelief belief(Pose2(at), Eigen::Map<const Matrix3d>(at + 3));
  at += 12;
  for (Eigen::Index k = 0; k < clones; ++k, at += 4) {
    belief.clones_.push_back({static_cast<std::uint64_t>(at[0]), Pose2(at + 1)});
  }
  belief.cross_ = Eigen::Map<const Eigen::Matrix3Xd>(at, 3, 3 * clones);
  belief.P_clones_ = Eigen::Map<const Eigen::MatrixXd>(at + 9 * clones, 3 * clones, 3 * clones);
  return belief;
}

}  // namespace thing_kin
