#pragma once

#include <Eigen/Core>

namespace thing_kin {

/// A planar pose (x, y, theta) in metres and radians; theta in (-pi, pi] where this file makes one.
using Pose2 = Eigen::Vector3d;

/// A planar twist (vx, vy, omega) in the frame of the body; times seconds it is a motion.
using Twist2 = Eigen::Vector3d;

/// The same angle in (-pi, pi].
double wrap_angle(double angle);

/// T_a_c = T_a_b T_b_c.
Pose2 compose(const Pose2& a_b, const Pose2& b_c);
Pose2 inverse(const Pose2& pose);

/// T_a_b from T_w_a and T_w_b: b as a sees it.
Pose2 between(const Pose2& a, const Pose2& b);

/// a - b in world axes, theta wrapped.
Pose2 pose_difference(const Pose2& a, const Pose2& b);

/// The pose reached from zero by a constant twist held for one second.
Pose2 se2_exp(const Twist2& xi);

/// The motion whose exponential the pose is; its omega is the pose's theta.
Twist2 se2_log(const Pose2& pose);

/// Ad(T): twist in b to twist in a for T = T_a_b.
Eigen::Matrix3d se2_adjoint(const Pose2& pose);

/// exp(xi + d) = exp(J_l(xi) d) exp(xi) to first order.
Eigen::Matrix3d se2_left_jacobian(const Twist2& xi);

/// exp(xi + d) = exp(xi) exp(J_r(xi) d) to first order; J_r(xi) = J_l(-xi).
Eigen::Matrix3d se2_right_jacobian(const Twist2& xi);

/// Inverses; singular where omega is 2 pi k, k not 0.
Eigen::Matrix3d se2_left_jacobian_inverse(const Twist2& xi);
Eigen::Matrix3d se2_right_jacobian_inverse(const Twist2& xi);

}  // namespace thing_kin
