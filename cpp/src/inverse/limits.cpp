#include "thing_kin/inverse/limits.hpp"

#include <algorithm>
#include <cmath>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

void check_positive(double value, const char* name) {
  if (!(std::isfinite(value) && value > 0.0)) {
    throw InvalidArgument(name, text(value), "a finite number > 0");
  }
}

// upper - q, rounded so that q + it is no more than upper.
double room_above(double q, double upper) {
  double room = upper - q;
  while (q + room > upper) {
    room = std::nextafter(room, -kInfinity);
  }
  return room;
}

// An interval and what its ends come from.
struct Interval {
  double lower, upper;
  LimitKind lower_kind, upper_kind;

  // What is common with [l, u]; if nothing is, the end nearest to it. l <= u.
  void restrict_to(double l, double u, LimitKind kind) {
    if (l > lower) {
      lower = std::min(l, upper);
      lower_kind = kind;
    }
    if (u < upper) {
      upper = std::max(u, lower);
      upper_kind = kind;
    }
  }
};

Interval joint_interval(double below, double above, double speed, double previous, double change) {
  Interval step{-speed, speed, LimitKind::kVelocity, LimitKind::kVelocity};
  step.restrict_to(-std::max(below, 0.0), std::max(above, 0.0), LimitKind::kPosition);
  if (change < kInfinity) {
    step.restrict_to(previous - change, previous + change, LimitKind::kAcceleration);
  }
  // Braking, or coming back: no faster than can be stopped at the other side.
  const double least = -(below >= 0.0 ? braking_step(below, change) : below);
  const double most = above >= 0.0 ? braking_step(above, change) : above;
  if (above < 0.0) {
    step.restrict_to(least, std::max(least, most), LimitKind::kPosition);
  } else {
    step.restrict_to(std::min(least, most), most, LimitKind::kPosition);
  }
  return step;
}

}  // namespace

const char* to_string(LimitKind kind) {
  switch (kind) {
    case LimitKind::kPosition:
      return "position";
    case LimitKind::kVelocity:
      return "velocity";
    case LimitKind::kAcceleration:
      return "acceleration";
    case LimitKind::kStep:
      return "step";
    case LimitKind::kNone:
      break;
  }
  return "";
}

WheelLimits::WheelLimits(double wheel_radius, double half_base_and_track, double largest_speed)
    : radius(wheel_radius), k(half_base_and_track), speed(largest_speed) {
  check_positive(radius, "radius");
  check_positive(k, "k");
  check_positive(speed, "speed");
}

Eigen::Matrix<double, 4, 3> WheelLimits::rows(double theta) const noexcept {
  const double c = std::cos(theta) / radius;
  const double s = std::sin(theta) / radius;
  const double turn = k / radius;
  Eigen::Matrix<double, 4, 3> rows;
  // (v_x -+ v_y -+ k omega) / R with v turned into the base's axes.
  rows << c + s, s - c, -turn,  //
      c - s, s + c, -turn,      //
      c + s, s - c, turn,       //
      c - s, s + c, turn;
  return rows;
}

LimitOptions::LimitOptions(double duration, std::optional<WheelLimits> wheel_limits)
    : dt(duration), wheels(wheel_limits) {
  check_positive(dt, "dt");
}

double braking_step(double room, double change) noexcept {
  if (!(room > 0.0 && change < kInfinity)) {
    return room;
  }
  // A step of m changes and what is left, m c <= x < (m + 1) c, takes (m + 1) x - m (m + 1) c / 2
  // until it has stopped.
  const double ratio = 2.0 * room / change;
  const double m = std::floor(0.5 * (std::sqrt(1.0 + 4.0 * ratio) - 1.0));
  if (!(m < 1e15)) {
    return std::sqrt(2.0 * room) * std::sqrt(change);  // the step is beyond counting
  }
  return std::min(room, room / (m + 1.0) + 0.5 * m * change);
}

void step_box(const Chain& chain, const double* q, const double* previous, const double* largest,
              double dt, StepBox& box) noexcept {
  const int n = chain.dof();
  box.lower.resize(n);
  box.upper.resize(n);
  for (int i = 0; i < n; ++i) {
    const double speed = chain.velocity_limits()[i] * dt;
    const double change =
        previous != nullptr ? chain.acceleration_limits()[i] * dt * dt : kInfinity;
    Interval step =
        joint_interval(room_above(-q[i], -chain.lower()[i]), room_above(q[i], chain.upper()[i]),
                       speed, previous != nullptr ? previous[i] : 0.0, change);
    if (largest != nullptr) {
      step.restrict_to(-largest[i], largest[i], LimitKind::kStep);
    }
    const auto k = static_cast<std::size_t>(i);
    box.lower[i] = step.lower;
    box.upper[i] = step.upper;
    box.lower_kind[k] = step.lower_kind;
    box.upper_kind[k] = step.upper_kind;
  }
}

}  // namespace thing_kin
