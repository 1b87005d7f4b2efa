#pragma once

#include <array>
#include <string>

#include "thing_kin/kinematics/posture.hpp"
#include "thing_kin/linalg/selectively_damped.hpp"

namespace thing_kin {

/// A task at one posture: J dq should be e.
struct TaskValue {
  SmallMatrix jacobian;
  SmallVector error;
};

/// Something the robot should do. A task answers two questions: how far it is from its target, and
/// how that changes with q.
class Task {
 public:
  virtual ~Task() = default;

  /// "PoseTask", for messages.
  virtual const char* kind() const noexcept = 0;

  /// Rows of its Jacobian on this chain.
  virtual int rows(const Chain& chain) const noexcept = 0;

  /// Rows and columns of its target as the user gives it; columns 0: a vector.
  virtual std::array<int, 2> target_shape(const Chain& chain) const noexcept = 0;

  virtual bool needs_base() const noexcept { return false; }

  /// How many joints the chain must have; 0: any number.
  virtual int joints() const noexcept { return 0; }

  virtual RowBlocks blocks(const Chain& chain) const noexcept {
    return RowBlocks::whole(rows(chain));
  }

  /// `target` has target_shape() entries, row by row; `frame` is the index of frame().
  virtual void evaluate(const Chain& chain, const Posture& posture, int frame, const double* q,
                        const double* target, TaskValue& value) const noexcept = 0;

  /// The step asks for gain * error, [M17] (4.3).
  double gain() const noexcept { return gain_; }

  /// The frame it is about; empty: the chain's last.
  const std::string& frame() const noexcept { return frame_; }

 protected:
  /// Throws InvalidArgument unless the gain is finite and positive.
  Task(double gain, std::string frame);

 private:
  double gain_;
  std::string frame_;
};

/// A frame's pose; target (4, 4) in the root.
class PoseTask final : public Task {
 public:
  explicit PoseTask(double gain = 1.0, std::string frame = "") : Task(gain, std::move(frame)) {}
  const char* kind() const noexcept override { return "PoseTask"; }
  int rows(const Chain& /*chain*/) const noexcept override { return 6; }
  std::array<int, 2> target_shape(const Chain& /*chain*/) const noexcept override { return {4, 4}; }
  RowBlocks blocks(const Chain& /*chain*/) const noexcept override { return RowBlocks::pose(); }
  void evaluate(const Chain& chain, const Posture& posture, int frame, const double* q,
                const double* target, TaskValue& value) const noexcept override;
};

/// A frame's origin; target (3), m.
class PositionTask final : public Task {
 public:
  explicit PositionTask(double gain = 1.0, std::string frame = "") : Task(gain, std::move(frame)) {}
  const char* kind() const noexcept override { return "PositionTask"; }
  int rows(const Chain& /*chain*/) const noexcept override { return 3; }
  std::array<int, 2> target_shape(const Chain& /*chain*/) const noexcept override { return {3, 0}; }
  void evaluate(const Chain& chain, const Posture& posture, int frame, const double* q,
                const double* target, TaskValue& value) const noexcept override;
};

/// A frame's orientation; target (3, 3).
class OrientationTask final : public Task {
 public:
  explicit OrientationTask(double gain = 1.0, std::string frame = "")
      : Task(gain, std::move(frame)) {}
  const char* kind() const noexcept override { return "OrientationTask"; }
  int rows(const Chain& /*chain*/) const noexcept override { return 3; }
  std::array<int, 2> target_shape(const Chain& /*chain*/) const noexcept override { return {3, 3}; }
  void evaluate(const Chain& chain, const Posture& posture, int frame, const double* q,
                const double* target, TaskValue& value) const noexcept override;
};

/// (x, y, theta) of the omnidirectional base; target (3). The error of theta is in (-pi, pi].
class BaseTask final : public Task {
 public:
  explicit BaseTask(double gain = 1.0) : Task(gain, "") {}
  const char* kind() const noexcept override { return "BaseTask"; }
  int rows(const Chain& /*chain*/) const noexcept override { return 3; }
  std::array<int, 2> target_shape(const Chain& /*chain*/) const noexcept override { return {3, 0}; }
  bool needs_base() const noexcept override { return true; }
  void evaluate(const Chain& chain, const Posture& posture, int frame, const double* q,
                const double* target, TaskValue& value) const noexcept override;
};

/// The whole configuration; target (n). A base's theta and continuous joints go the short way.
class PostureTask final : public Task {
 public:
  explicit PostureTask(double gain = 1.0) : Task(gain, "") {}
  const char* kind() const noexcept override { return "PostureTask"; }
  int rows(const Chain& chain) const noexcept override { return chain.dof(); }
  std::array<int, 2> target_shape(const Chain& chain) const noexcept override {
    return {chain.dof(), 0};
  }
  void evaluate(const Chain& chain, const Posture& posture, int frame, const double* q,
                const double* target, TaskValue& value) const noexcept override;
};

}  // namespace thing_kin
