#include "thing_kin/inverse/pose_residual.hpp"

#include <cmath>

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

// As so3_log, with the coefficient of its derivative, which has the same half angle h.
void set_log(const Eigen::Matrix3d& R, PoseResidual::Value& value) {
  const Eigen::Vector4d q = quaternion_from_rotation(R);
  const double sine = q.tail<3>().norm();
  constexpr double kSmall = 1e-2;  // here (1 - h cot h)/(4 h^2) would cancel
  const double h = sine < 1e-8 ? sine / q[0] : std::atan2(sine, q[0]);
  value.log = (sine < 1e-8 ? 2.0 / q[0] : 2.0 * h / sine) * q.tail<3>();
  const double square = 4.0 * h * h;
  value.curvature = sine < kSmall ? 1.0 / 12 + square * (1.0 / 720 + square / 30240)
                                  : (1.0 - h * q[0] / sine) / square;
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
    set_log(target_.rotation * T.rotation.transpose(), value);
  } else {
    value.log.setZero();
    value.curvature = 0.0;
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

Eigen::Vector3d PoseResidual::way_from(const Eigen::Vector3d& translation) const noexcept {
  Eigen::Vector3d way = target_.translation - translation;
  if (has_all_of_position()) {
    return way;
  }
  if (!target_axes_) {
    return counts_.head<3>().cwiseProduct(way);
  }
  return target_.rotation * counts_.head<3>().cwiseProduct(target_.rotation.transpose() * way);
}

RowFactors PoseResidual::derivative(const Value& value) const noexcept {
  // J_r^-1(a) = I + [a]/2 + c [a]^2, and [a]^2 = a a^T - |a|^2 I.
  const Eigen::Vector3d& a = value.log;
  const double c = value.curvature;
  Eigen::Matrix3d angular = c * a * a.transpose();
  angular.diagonal().array() += 1.0 - c * a.squaredNorm();
  angular += 0.5 * skew(a);
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  if (target_axes_) {
    linear = target_.rotation.transpose();
    angular = target_.rotation.transpose() * angular;
  }
  RowFactors factors;
  factors.set(scale_.head<3>().asDiagonal() * linear, scale_.tail<3>().asDiagonal() * angular);
  return factors;
}

}  // namespace thing_kin
