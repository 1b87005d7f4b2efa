#include "thing_kin/inverse/set_task.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/jacobian.hpp"

namespace thing_kin {

namespace {

// One row: the value, its interval, and zero for a Jacobian.
void one_row(int n, double value, double lower, double upper, IntervalValue& interval) {
  interval.jacobian.setZero(1, n);
  interval.value.setConstant(1, value);
  interval.lower.setConstant(1, lower);
  interval.upper.setConstant(1, upper);
}

// A unit vector orthogonal to a unit vector.
Eigen::Vector3d orthogonal_to(const Eigen::Vector3d& a) {
  Eigen::Index least = 0;
  a.cwiseAbs().minCoeff(&least);
  return a.cross(Eigen::Vector3d::Unit(least)).normalized();
}

}  // namespace

SetTask::SetTask(double gain, std::string frame) : Task(gain, std::move(frame)) {
  if (gain > 1.0) {
    throw InvalidArgument("gain", text(gain), "a number > 0, at most 1 for an interval");
  }
}

void SetTask::evaluate(const Chain& chain, const Posture& posture, int frame, const double* q,
                       const double* target, TaskValue& value) const noexcept {
  IntervalValue interval;
  evaluate_interval(chain, posture, frame, q, target, interval);
  value.jacobian = interval.jacobian;
  value.error = interval.value.cwiseMax(interval.lower).cwiseMin(interval.upper) - interval.value;
}

DistanceTask::DistanceTask(double lower, double upper, double gain, std::string frame)
    : SetTask(gain, std::move(frame)), lower_(lower), upper_(upper) {
  if (!(std::isfinite(lower) && lower >= 0.0)) {
    throw InvalidArgument("lower", text(lower), "a finite number >= 0");
  }
  if (!(upper >= lower)) {
    throw InvalidArgument("upper", text(upper), "a number >= lower, or inf");
  }
}

void DistanceTask::evaluate_interval(const Chain& chain, const Posture& posture, int frame,
                                     const double* /*q*/, const double* target,
                                     IntervalValue& interval) const noexcept {
  const Eigen::Map<const Eigen::Vector3d> point(target);
  const Eigen::Vector3d way = frame_pose(chain, posture, frame).translation - point;
  const double distance = way.stableNorm();
  one_row(chain.dof(), distance, lower_, upper_, interval);
  // At the point itself every way leads off: x.
  const Eigen::Vector3d direction =
      distance > 0.0 ? Eigen::Vector3d(way / distance) : Eigen::Vector3d::UnitX();
  interval.jacobian.noalias() =
      direction.transpose() * world_aligned_jacobian(chain, posture, frame).topRows<3>();
}

BaseObstacleTask::BaseObstacleTask(double radius, double gain)
    : SetTask(gain, ""), radius_(radius) {
  if (!(std::isfinite(radius) && radius > 0.0)) {
    throw InvalidArgument("radius", text(radius), "a finite number > 0");
  }
}

void BaseObstacleTask::evaluate_interval(const Chain& chain, const Posture& /*posture*/,
                                         int /*frame*/, const double* q, const double* target,
                                         IntervalValue& interval) const noexcept {
  const auto& base = *chain.base_joints();
  const Eigen::Vector2d way(q[base[0]] - target[0], q[base[1]] - target[1]);
  const double distance = way.stableNorm();
  one_row(chain.dof(), distance, radius_, kInfinity, interval);
  interval.jacobian(0, base[0]) = distance > 0.0 ? way[0] / distance : 1.0;
  interval.jacobian(0, base[1]) = distance > 0.0 ? way[1] / distance : 0.0;
}

FieldOfViewTask::FieldOfViewTask(double limit, const Eigen::Vector3d& axis, double gain,
                                 std::string frame)
    : SetTask(gain, std::move(frame)), limit_(limit), axis_(axis.stableNormalized()) {
  if (!(limit > 0.0 && limit < std::numbers::pi)) {
    throw InvalidArgument("limit", text(limit), "an angle in (0, pi)");
  }
  if (!(std::abs(axis_.norm() - 1.0) < 1e-6)) {
    throw InvalidArgument("axis", "no direction", "three finite numbers, not all zero");
  }
}

void FieldOfViewTask::evaluate_interval(const Chain& chain, const Posture& posture, int frame,
                                        const double* /*q*/, const double* target,
                                        IntervalValue& interval) const noexcept {
  const Eigen::Map<const Eigen::Vector3d> point(target);
  const SE3 T = frame_pose(chain, posture, frame);
  const Eigen::Vector3d a = T.rotation * axis_;
  const Eigen::Vector3d way = point - T.translation;
  const double distance = way.stableNorm();
  one_row(chain.dof(), 0.0, 0.0, limit_, interval);
  if (!(distance > 0.0)) {
    return;  // the point is in the camera: seen
  }
  const Eigen::Vector3d d = way / distance;
  const Eigen::Vector3d turn = a.cross(d);
  const double sine = turn.norm();
  const double cosine = a.dot(d);
  interval.value[0] = std::atan2(sine, cosine);
  if (sine == 0.0 && cosine > 0.0) {
    return;  // straight ahead, where the angle has its tip
  }
  // The angle falls with a turn about u and with a motion along d x u over the distance.
  const Eigen::Vector3d u = sine > 0.0 ? Eigen::Vector3d(turn / sine) : orthogonal_to(a);
  const Jacobian J = world_aligned_jacobian(chain, posture, frame);
  interval.jacobian.noalias() =
      (d.cross(u) / distance).transpose() * J.topRows<3>() - u.transpose() * J.bottomRows<3>();
}

JointRangeTask::JointRangeTask(JointVector lower, JointVector upper, double gain)
    : SetTask(gain, ""), lower_(std::move(lower)), upper_(std::move(upper)) {
  if (lower_.size() != upper_.size()) {
    throw InvalidArgument("upper", std::to_string(upper_.size()) + " numbers",
                          std::to_string(lower_.size()) + ", as many as lower");
  }
  if (!(lower_.array() <= upper_.array()).all()) {
    throw InvalidArgument("lower", "a number above upper, or NaN", "lower <= upper");
  }
}

void JointRangeTask::evaluate_interval(const Chain& chain, const Posture& /*posture*/,
                                       int /*frame*/, const double* q, const double* /*target*/,
                                       IntervalValue& interval) const noexcept {
  const int n = chain.dof();
  interval.jacobian.setIdentity(n, n);
  interval.value = Eigen::Map<const Eigen::VectorXd>(q, n);
  interval.lower = lower_;
  interval.upper = upper_;
}

}  // namespace thing_kin
