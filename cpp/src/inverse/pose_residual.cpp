#include "thing_kin/inverse/pose_residual.hpp"

#include "thing_kin/core/error.hpp"
#include "thing_kin/core/tolerance.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin {

WeightAxes weight_axes_from_string(const std::string& name) {
  if (name == "target") {
    return WeightAxes::kTarget;
  }
  if (name == "world") {
    return WeightAxes::kWorld;
  }
  throw InvalidArgument("weight_axes", quoted(name), "'target' or 'world'");
}

namespace {

// A matrix with few digits is meant to be the rotation next to it; without this the error could not
// fall below its rounding.
SE3 orthonormal(const SE3& T) {
  const Eigen::Matrix3d gram = T.rotation.transpose() * T.rotation;
  if (gram.isIdentity(8 * kEpsilon)) {
    return T;
  }
  return {rotation_from_quaternion(quaternion_from_rotation(T.rotation)), T.translation};
}

}  // namespace

PoseResidual::PoseResidual(const SE3& target, const PoseWeights& weights, double length) noexcept
    : target_(orthonormal(target)) {
  scale_ = Eigen::Map<const Vector6>(weights.weight.data());
  counts_ = (scale_.array() > 0.0).cast<double>();
  has_position_ = !scale_.head<3>().isZero(0.0);
  has_rotation_ = !scale_.tail<3>().isZero(0.0);
  isotropic_ = scale_[0] == scale_[1] && scale_[1] == scale_[2] && scale_[3] == scale_[4] &&
               scale_[4] == scale_[5];
  target_axes_ = !isotropic_ && weights.axes == WeightAxes::kTarget;
  scale_.head<3>() /= length;
}

void PoseResidual::evaluate(const SE3& T, Value& value) const noexcept {
  Eigen::Vector3d position = target_.translation - T.translation;
  if (has_rotation_) {
    value.log = so3_log(target_.rotation * T.rotation.transpose());
  } else {
    value.log.setZero();
  }
  if (isotropic_) {
    value.position_error = has_position_ ? position.norm() : 0.0;
    value.rotation_error = value.log.norm();
    value.e << scale_[0] * position, scale_[3] * value.log;
    return;
  }
  Eigen::Vector3d rotation = value.log;
  if (target_axes_) {
    position = target_.rotation.transpose() * position;
    rotation = target_.rotation.transpose() * rotation;
  }
  value.position_error = position.cwiseProduct(counts_.head<3>()).norm();
  value.rotation_error = rotation.cwiseProduct(counts_.tail<3>()).norm();
  value.e.head<3>() = scale_.head<3>().cwiseProduct(position);
  value.e.tail<3>() = scale_.tail<3>().cwiseProduct(rotation);
}

void PoseResidual::derivative(const Value& value, Eigen::Matrix3d& linear,
                              Eigen::Matrix3d& angular) const noexcept {
  linear.setIdentity();
  angular.setIdentity();
  if (has_rotation_) {
    angular = so3_right_jacobian_inverse(value.log);
  }
  if (target_axes_) {
    linear = target_.rotation.transpose();
    angular = target_.rotation.transpose() * angular;
  }
  linear = scale_.head<3>().asDiagonal() * linear;
  angular = scale_.tail<3>().asDiagonal() * angular;
}

Vector6 PoseResidual::force(const Value& value) const noexcept {
  Eigen::Matrix3d linear;
  Eigen::Matrix3d angular;
  derivative(value, linear, angular);
  Vector6 force;
  force << linear.transpose() * value.e.head<3>(), angular.transpose() * value.e.tail<3>();
  return force;
}

void PoseResidual::weigh(const Value& value, Jacobian& J) const noexcept {
  Eigen::Matrix3d linear;
  Eigen::Matrix3d angular;
  derivative(value, linear, angular);
  for (Eigen::Index j = 0; j < J.cols(); ++j) {
    J.col(j).head<3>() = (linear * J.col(j).head<3>()).eval();
    J.col(j).tail<3>() = (angular * J.col(j).tail<3>()).eval();
  }
}

}  // namespace thing_kin
