#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "thing_kin/core/types.hpp"

namespace thing_kin {

/// A rigid transform. `T_a_b` maps coordinates in b to coordinates in a.
struct SE3 {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  SE3 operator*(const SE3& other) const {
    SE3 product;
    product.rotation.noalias() = rotation * other.rotation;
    product.translation.noalias() = rotation * other.translation;
    product.translation += translation;
    return product;
  }
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation * point + translation;
  }
  SE3 inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
  Eigen::Matrix4d matrix() const;

  bool operator==(const SE3&) const = default;
};

/// Rigid within kRotationTolerance: the last row is (0, 0, 0, 1), R^T R = I, det R = 1, all finite.
bool is_rigid(const Eigen::Matrix4d& T);

/// Twists are [linear, angular], metres and radians, everywhere.
SE3 se3_exp(const Vector6& xi);

/// The twist of T, its angular part in [0, pi] (see so3_log for pi itself).
Vector6 se3_log(const SE3& T);

/// Ad(T): twist in b to twist in a for T = T_a_b.
Matrix6 se3_adjoint(const SE3& T);

/// Lie bracket: d/dt (Ad(exp(t a)) b) at t = 0.
inline Vector6 se3_bracket(const Vector6& a, const Vector6& b) {
  Vector6 bracket;
  bracket << a.tail<3>().cross(b.head<3>()) + a.head<3>().cross(b.tail<3>()),
      a.tail<3>().cross(b.tail<3>());
  return bracket;
}

/// exp(xi + d) = exp(J_l(xi) d) exp(xi) to first order.
Matrix6 se3_left_jacobian(const Vector6& xi);

/// exp(xi + d) = exp(xi) exp(J_r(xi) d) to first order; J_r(xi) = J_l(-xi).
Matrix6 se3_right_jacobian(const Vector6& xi);

/// Inverses; singular where the angular part has norm 2 pi k, k > 0.
Matrix6 se3_left_jacobian_inverse(const Vector6& xi);
Matrix6 se3_right_jacobian_inverse(const Vector6& xi);

}  // namespace thing_kin
