#pragma once

#include <span>

#include <Eigen/Core>

#include "thing_kin/lie/se2.hpp"

namespace thing_kin {

/// A planar pose that is known so well: the covariance of (x, y, theta) is in world axes.
struct PlanarEstimate {
  Pose2 pose = Pose2::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// [M17] (3.22) for a planar robot: the default covariance of a twist that wheels have measured,
/// diag(0.001, 0.001, 0.03) in (m/s)^2 and (rad/s)^2.
Eigen::Matrix3d default_twist_covariance();

/// The pose after a twist (of the body, constant) has been held for dt seconds; exact.
Pose2 integrate_twist(const Pose2& pose, const Twist2& twist, double dt) noexcept;

/// Derivatives of the pose after a motion `xi` = twist dt by the pose before and by the motion,
/// each (x, y, theta) in world axes.
struct MotionJacobians {
  Eigen::Matrix3d by_pose;
  Eigen::Matrix3d by_motion;
};
MotionJacobians motion_jacobians(const Pose2& pose, const Twist2& xi) noexcept;

/// Moves the estimate by a motion with its own covariance, independent of the estimate's.
void move(PlanarEstimate& estimate, const Twist2& xi, const Eigen::Matrix3d& covariance) noexcept;

/// One row of a record: a motion, and by what a common covariance is multiplied to give its own:
/// dt^2 for that of a twist, the way travelled for a variance that is given for each metre.
struct NoisyMotion {
  Twist2 xi = Twist2::Zero();
  double noise = 0.0;
};

/// Dead reckoning: out[0] is the start, out[i + 1] follows from motions[i]; their errors are
/// independent. `out` is longer by one than `motions`.
void dead_reckon(const PlanarEstimate& start, std::span<const NoisyMotion> motions,
                 const Eigen::Matrix3d& covariance, std::span<PlanarEstimate> out) noexcept;

}  // namespace thing_kin
