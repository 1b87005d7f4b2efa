#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "thing_kin/lie/se3.hpp"

namespace thing_kin {

/// A continuous joint is a revolute one without limits: q and q + 2 pi are the same place.
enum class JointType : std::uint8_t { kFixed, kRevolute, kPrismatic, kContinuous };

/// Turns about its axis, within limits or without.
constexpr bool is_rotary(JointType type) {
  return type == JointType::kRevolute || type == JointType::kContinuous;
}

/// "fixed", "revolute", "prismatic", "continuous".
const char* to_string(JointType type);
JointType joint_type_from_string(const std::string& name);

/// What a joint may do: rad or m, rad/s or m/s, rad/s^2 or m/s^2. Rates bound the absolute value.
struct JointLimits {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double velocity = std::numeric_limits<double>::infinity();
  double acceleration = std::numeric_limits<double>::infinity();

  bool operator==(const JointLimits&) const = default;
};

/// Throws InvalidArgument unless lower <= upper, the rates are positive and nothing is NaN; and if
/// a continuous joint has a position limit.
void check(JointType type, const JointLimits& limits);

/// One link of a chain: its frame is parent * before * joint(q) * after, where the joint turns
/// about or slides along z. Denavit-Hartenberg rows and URDF joints both come down to this.
struct Segment {
  std::string frame;
  std::string joint;  ///< empty if fixed
  JointType type = JointType::kFixed;
  SE3 before;
  SE3 after;
  JointLimits limits;

  bool operator==(const Segment&) const = default;
};

}  // namespace thing_kin
