#include "closed_form_ik_polish.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/kinematics/pose_error.hpp"
#include "thing_kin/kinematics/posture.hpp"

namespace thing_kin::closed_form {

namespace {

/// The error, and the Jacobian of the joints that may move.
struct Linearization {
  Vector6 error;
  Matrix6 J;

  Linearization(const Goal& goal, const double* q) noexcept {
    Posture posture;
    Jacobian whole;
    place_joints(goal.chain, q, posture);
    error = pose_error(frame_pose(goal.chain, posture, goal.frame), goal.target);
    geometric_jacobian(goal.chain, posture, goal.frame, ReferenceFrame::kWorldAligned, whole);
    for (int i = 0; i < 6; ++i) {
      J.col(i) = whole.col(goal.joints[static_cast<std::size_t>(i)]);
    }
  }
};

Vector6 error_at(const Goal& goal, const double* q) noexcept {
  return pose_error(forward_kinematics(goal.chain, q, goal.frame), goal.target);
}

PoseDistance distance_of(const Vector6& error) noexcept {
  return {error.head<3>().norm(), error.tail<3>().norm()};
}

void move(const Goal& goal, const double* from, const Vector6& step, double* to) noexcept {
  std::copy_n(from, goal.chain.dof(), to);
  for (int i = 0; i < 6; ++i) {
    to[goal.joints[static_cast<std::size_t>(i)]] += step[i];
  }
}

/// A damped step, no joint by more than half a radian.
Vector6 step_of(const Linearization& at, double damping) noexcept {
  constexpr double kLargestStep = 0.5;
  const Vector6 gradient = at.J.transpose() * at.error;
  Matrix6 H = at.J.transpose() * at.J;
  H.diagonal().array() += damping;
  const Vector6 step = H.ldlt().solve(gradient);
  const double largest = step.cwiseAbs().maxCoeff();
  return largest > kLargestStep ? Vector6(step * (kLargestStep / largest)) : step;
}

}  // namespace

PoseDistance distance(const double* pose, const SE3& target) noexcept {
  using RowMajor = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> T(pose);
  const Eigen::Matrix3d& R = target.rotation;
  // Twice the sine times the axis, from R to T: the part of T R^T that is not symmetric.
  const Eigen::Matrix3d E = T.leftCols<3>() * R.transpose();
  const double x = E(2, 1) - E(1, 2);
  const double y = E(0, 2) - E(2, 0);
  const double z = E(1, 0) - E(0, 1);
  const double sine = 0.5 * std::sqrt(x * x + y * y + z * z);
  const double cosine = 0.5 * (E.trace() - 1.0);
  constexpr double kSmall = 1e-6;  // where sine and angle differ by less than 1e-18
  const double angle = sine < kSmall && cosine > 0.0 ? sine : std::atan2(sine, cosine);
  return {(T.col(3) - target.translation).norm(), angle};
}

PoseDistance polish(const Goal& goal, double* q) noexcept {
  constexpr int kMostSteps = 200;
  constexpr double kDone = 1e-15;
  constexpr double kMostDamping = 1e12;
  double damping = 1e-18;
  double trial[kMaxDof];
  Linearization at(goal, q);
  double cost = at.error.squaredNorm();
  for (int i = 0; i < kMostSteps && cost > kDone * kDone && damping < kMostDamping; ++i) {
    const Vector6 step = step_of(at, damping);
    move(goal, q, step, trial);
    const double next = error_at(goal, trial).squaredNorm();
    if (!(next < cost)) {
      damping = std::max(damping * 30.0, 1e-12);
      continue;
    }
    std::copy_n(trial, goal.chain.dof(), q);
    const bool settled = cost - next <= 1e-14 * cost;
    at = Linearization(goal, q);
    cost = next;
    damping *= 0.1;
    if (settled) {
      break;
    }
  }
  return distance_of(at.error);
}

}  // namespace thing_kin::closed_form
