#include "thing_kin/model/segment.hpp"

#include <cmath>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

void check_rate(double rate, const char* argument) {
  if (!(rate > 0.0)) {
    throw InvalidArgument(argument, text(rate), "a number > 0 (inf: unlimited)");
  }
}

}  // namespace

const char* to_string(JointType type) {
  switch (type) {
    case JointType::kRevolute:
      return "revolute";
    case JointType::kPrismatic:
      return "prismatic";
    case JointType::kContinuous:
      return "continuous";
    case JointType::kFixed:
      break;
  }
  return "fixed";
}

JointType joint_type_from_string(const std::string& name) {
  for (const JointType type :
       {JointType::kFixed, JointType::kRevolute, JointType::kPrismatic, JointType::kContinuous}) {
    if (name == to_string(type)) {
      return type;
    }
  }
  throw InvalidArgument("joint", quoted(name), "'revolute', 'continuous', 'prismatic' or 'fixed'");
}

void check(JointType type, const JointLimits& limits) {
  if (std::isnan(limits.lower) || std::isnan(limits.upper)) {
    throw InvalidArgument("lower, upper", text(limits.lower) + ", " + text(limits.upper), "no NaN");
  }
  if (limits.lower > limits.upper || limits.lower == HUGE_VAL || limits.upper == -HUGE_VAL) {
    throw InvalidArgument("lower", text(limits.lower) + " with upper = " + text(limits.upper),
                          "lower <= upper");
  }
  if (type == JointType::kContinuous && (limits.lower > -HUGE_VAL || limits.upper < HUGE_VAL)) {
    const bool below = limits.lower > -HUGE_VAL;
    throw InvalidArgument(below ? "lower" : "upper", text(below ? limits.lower : limits.upper),
                          "no limit (inf) for a continuous joint");
  }
  check_rate(limits.velocity, "velocity_limit");
  check_rate(limits.acceleration, "acceleration_limit");
}

}  // namespace thing_kin
