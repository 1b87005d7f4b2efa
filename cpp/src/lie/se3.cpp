#include "thing_kin/lie/se3.hpp"

#include <cmath>

#include <Eigen/LU>

#include "thing_kin/core/tolerance.hpp"
#include "thing_kin/lie/series.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin {

namespace {

// The upper right block of the left Jacobian of SE(3) (Barfoot 2017, 7.86b).
Eigen::Matrix3d left_jacobian_coupling(const Vector6& xi) {
  const Eigen::Matrix3d rho = skew(xi.head<3>());
  const Eigen::Vector3d phi_vector = xi.tail<3>();
  const Eigen::Matrix3d S = skew(phi_vector);
  const double t = phi_vector.squaredNorm();
  const double c1 = phi<3>(t);
  const double c2 = phi<4>(t);
  const double c3 = 0.5 * (phi<4>(t) - 3.0 * phi<5>(t));
  const Eigen::Matrix3d SrhoS = S * rho * S;
  return 0.5 * rho + c1 * (S * rho + rho * S + SrhoS) +
         c2 * (S * S * rho + rho * S * S - 3.0 * SrhoS) + c3 * (SrhoS * S + S * SrhoS);
}

}  // namespace

Eigen::Matrix4d SE3::matrix() const {
  Eigen::Matrix4d T;
  T << rotation, translation, 0.0, 0.0, 0.0, 1.0;
  return T;
}

bool is_rigid(const Eigen::Matrix4d& T) {
  if (!T.allFinite()) {
    return false;
  }
  const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
  const double last_row = (T.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff();
  const double orthogonality =
      (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return last_row <= kEpsilon && orthogonality <= kRotationTolerance && R.determinant() > 0.0;
}

SE3 se3_exp(const Vector6& xi) {
  const Eigen::Vector3d phi_vector = xi.tail<3>();
  return {so3_exp(phi_vector), so3_left_jacobian(phi_vector) * xi.head<3>()};
}

Vector6 se3_log(const SE3& T) {
  const Eigen::Vector3d phi_vector = so3_log(T.rotation);
  Vector6 xi;
  xi << so3_left_jacobian_inverse(phi_vector) * T.translation, phi_vector;
  return xi;
}

Matrix6 se3_adjoint(const SE3& T) {
  Matrix6 Ad;
  Ad << T.rotation, skew(T.translation) * T.rotation, Eigen::Matrix3d::Zero(), T.rotation;
  return Ad;
}

Matrix6 se3_left_jacobian(const Vector6& xi) {
  const Eigen::Matrix3d J = so3_left_jacobian(xi.tail<3>());
  Matrix6 left;
  left << J, left_jacobian_coupling(xi), Eigen::Matrix3d::Zero(), J;
  return left;
}

Matrix6 se3_right_jacobian(const Vector6& xi) { return se3_left_jacobian(-xi); }

Matrix6 se3_left_jacobian_inverse(const Vector6& xi) {
  const Eigen::Matrix3d J = so3_left_jacobian_inverse(xi.tail<3>());
  Matrix6 inverse;
  inverse << J, -J * left_jacobian_coupling(xi) * J, Eigen::Matrix3d::Zero(), J;
  return inverse;
}

Matrix6 se3_right_jacobian_inverse(const Vector6& xi) { return se3_left_jacobian_inverse(-xi); }

}  // namespace thing_kin
