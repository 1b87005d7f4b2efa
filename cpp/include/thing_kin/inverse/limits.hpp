#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "thing_kin/model/chain.hpp"

namespace thing_kin {

/// Speed limit of the four wheels of a mecanum base, [M17] (3.20).
struct WheelLimits {
  /// radius, m; k, m: half the wheel base plus half the track; speed, rad/s. All positive.
  WheelLimits(double wheel_radius, double half_base_and_track, double largest_speed);
  double radius;
  double k;
  double speed;
  bool operator==(const WheelLimits&) const = default;

  /// Wheel speeds are rows * (x, y, theta)' for a base turned by theta: the inverse of (3.20).
  /// Front left, rear left, rear right, front right.
  Eigen::Matrix<double, 4, 3> rows(double theta) const noexcept;
};

/// What a step is limited by: the chain's own limits and these.
struct LimitOptions {
  /// Throws InvalidArgument unless dt, s, is positive.
  explicit LimitOptions(double duration, std::optional<WheelLimits> wheel_limits = std::nullopt);
  double dt;  ///< duration of a step
  std::optional<WheelLimits> wheels;
};

/// What bounds a joint's step.
enum class LimitKind : std::uint8_t { kNone, kPosition, kVelocity, kAcceleration, kStep };
const char* to_string(LimitKind kind);

/// Where each joint's step may be: never empty, and zero is in it but for a joint that is outside
/// its limits or has to slow down.
struct StepBox {
  JointVector lower, upper;
  std::array<LimitKind, kMaxDof> lower_kind, upper_kind;
};

/// The longest step from which a joint can still stop within `room` when each further step may be
/// shorter by `change`; both >= 0, `change` may be infinite.
double braking_step(double room, double change) noexcept;

/// The box of q + dq within the position limits, |dq| <= velocity dt and, if `previous` (the step
/// before this one) is given, |dq - previous| <= acceleration dt^2, at a speed at which the joint
/// can still stop before its limit. Where these can't all hold, velocity goes first, then not
/// leaving the position limits, then acceleration, then braking, then coming back inside.
///
/// q + dq never leaves its limits, in floating point either, and then is within |dq| <= `largest`.
/// previous, largest: dof() entries or nullptr.
void step_box(const Chain& chain, const double* q, const double* previous, const double* largest,
              double dt, StepBox& box) noexcept;

}  // namespace thing_kin
