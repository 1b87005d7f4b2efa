#pragma once

#include "thing_kin/inverse/task.hpp"

namespace thing_kin {

/// A set-based task at one posture: value + J dq should be in [lower, upper].
struct IntervalValue {
  SmallMatrix jacobian;
  SmallVector value, lower, upper;
};

/// Something that should stay in an interval, Moe, Antonelli, Teel, Pettersen & Schrimpf (2016): no
/// task while it does. The gain is the share of an excess that one step takes away. For
/// TaskPriority with limits.
class SetTask : public Task {
 public:
  /// As Task::evaluate, without the gain.
  virtual void evaluate_interval(const Chain& chain, const Posture& posture, int frame,
                                 const double* q, const double* target,
                                 IntervalValue& interval) const noexcept = 0;

  /// The error is what brings it back into its interval, zero inside.
  void evaluate(const Chain& chain, const Posture& posture, int frame, const double* q,
                const double* target, TaskValue& value) const noexcept final;

 protected:
  /// Throws InvalidArgument unless the gain is in (0, 1].
  SetTask(double gain, std::string frame);
};

/// Distance of a frame's origin to a point, m; target: the point (3).
class DistanceTask final : public SetTask {
 public:
  /// Throws InvalidArgument unless 0 <= lower <= upper, lower finite; upper may be infinite.
  DistanceTask(double lower, double upper, double gain = 1.0, std::string frame = "");
  const char* kind() const noexcept override { return "DistanceTask"; }
  int rows(const Chain& /*chain*/) const noexcept override { return 1; }
  std::array<int, 2> target_shape(const Chain& /*chain*/) const noexcept override { return {3, 0}; }
  double lower() const noexcept { return lower_; }
  double upper() const noexcept { return upper_; }
  void evaluate_interval(const Chain& chain, const Posture& posture, int frame, const double* q,
                         const double* target, IntervalValue& interval) const noexcept override;

 private:
  double lower_, upper_;
};

/// The base keeps its distance to an obstacle, erratum to [M17] (4.29); target: its center (2), m.
class BaseObstacleTask final : public SetTask {
 public:
  /// radius, m: the least distance. Throws InvalidArgument unless it is finite and positive.
  explicit BaseObstacleTask(double radius, double gain = 1.0);
  const char* kind() const noexcept override { return "BaseObstacleTask"; }
  int rows(const Chain& /*chain*/) const noexcept override { return 1; }
  std::array<int, 2> target_shape(const Chain& /*chain*/) const noexcept override { return {2, 0}; }
  bool needs_base() const noexcept override { return true; }
  double radius() const noexcept { return radius_; }
  void evaluate_interval(const Chain& chain, const Posture& posture, int frame, const double* q,
                         const double* target, IntervalValue& interval) const noexcept override;

 private:
  double radius_;
};

/// A frame's axis points to a target within an angle: a camera sees it; target: the point (3), m.
class FieldOfViewTask final : public SetTask {
 public:
  /// limit, rad, in (0, pi); axis: in the frame, not zero.
  explicit FieldOfViewTask(double limit, const Eigen::Vector3d& axis = Eigen::Vector3d::UnitZ(),
                           double gain = 1.0, std::string frame = "");
  const char* kind() const noexcept override { return "FieldOfViewTask"; }
  int rows(const Chain& /*chain*/) const noexcept override { return 1; }
  std::array<int, 2> target_shape(const Chain& /*chain*/) const noexcept override { return {3, 0}; }
  double limit() const noexcept { return limit_; }
  const Eigen::Vector3d& axis() const noexcept { return axis_; }
  void evaluate_interval(const Chain& chain, const Posture& posture, int frame, const double* q,
                         const double* target, IntervalValue& interval) const noexcept override;

 private:
  double limit_;
  Eigen::Vector3d axis_;
};

/// Joints stay in ranges narrower than their limits; no target.
class JointRangeTask final : public SetTask {
 public:
  /// Throws InvalidArgument unless lower <= upper; infinities allowed.
  JointRangeTask(JointVector lower, JointVector upper, double gain = 1.0);
  const char* kind() const noexcept override { return "JointRangeTask"; }
  int rows(const Chain& chain) const noexcept override { return chain.dof(); }
  std::array<int, 2> target_shape(const Chain& /*chain*/) const noexcept override { return {0, 0}; }
  int joints() const noexcept override { return static_cast<int>(lower_.size()); }
  const JointVector& lower() const noexcept { return lower_; }
  const JointVector& upper() const noexcept { return upper_; }
  void evaluate_interval(const Chain& chain, const Posture& posture, int frame, const double* q,
                         const double* target, IntervalValue& interval) const noexcept override;

 private:
  JointVector lower_, upper_;
};

}  // namespace thing_kin
