#pragma once

#include <Eigen/Core>

namespace thing_kin {

/// The cross-product matrix: skew(a) b = a x b.
Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// Rotation by |phi| rad about phi (Rodrigues).
Eigen::Matrix3d so3_exp(const Eigen::Vector3d& phi);

/// Rotation vector of R, its norm in [0, pi]. Exact to rounding everywhere; at pi, where both
/// signs of the axis are right, its first nonzero component is positive.
Eigen::Vector3d so3_log(const Eigen::Matrix3d& R);

/// d exp: exp(phi + d) = exp(J_l(phi) d) exp(phi) to first order.
Eigen::Matrix3d so3_left_jacobian(const Eigen::Vector3d& phi);

/// exp(phi + d) = exp(phi) exp(J_r(phi) d) to first order; J_r(phi) = J_l(-phi).
Eigen::Matrix3d so3_right_jacobian(const Eigen::Vector3d& phi);

/// Inverses; singular at |phi| = 2 pi k, k > 0, where the result is not finite.
Eigen::Matrix3d so3_left_jacobian_inverse(const Eigen::Vector3d& phi);
Eigen::Matrix3d so3_right_jacobian_inverse(const Eigen::Vector3d& phi);

/// d/dphi of weights^T J_r^-1(phi): row k is its derivative by phi_k.
Eigen::Matrix3d so3_right_jacobian_inverse_derivative(const Eigen::Vector3d& phi,
                                                      const Eigen::Vector3d& weights);

/// Unit quaternion (w, x, y, z) with w >= 0; at w = 0 the first nonzero component is positive.
Eigen::Vector4d quaternion_from_rotation(const Eigen::Matrix3d& R);

/// Rotation of a quaternion (w, x, y, z), which need not be normalized but must not be zero.
Eigen::Matrix3d rotation_from_quaternion(const Eigen::Vector4d& wxyz);

/// R = Rz(yaw) Ry(pitch) Rx(roll), the URDF convention, from (roll, pitch, yaw).
Eigen::Matrix3d rotation_from_rpy(const Eigen::Vector3d& rpy);

/// (roll, pitch, yaw) of R, |roll|, |yaw| <= pi and |pitch| <= pi/2; the three give R back to
/// rounding everywhere. At |pitch| = pi/2, where only yaw -+ roll is determined, roll is 0.
Eigen::Vector3d rpy_from_rotation(const Eigen::Matrix3d& R);

}  // namespace thing_kin
