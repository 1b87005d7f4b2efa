#include "thing_kin/model/dh.hpp"

#include <cmath>
#include <numbers>

#include "thing_kin/core/error.hpp"
#include "thing_kin/core/tolerance.hpp"

namespace thing_kin {

namespace {

struct SinCos {
  double sin, cos;
};

SinCos exact_right_angles(double angle) {
  constexpr double kRightAngle = std::numbers::pi / 2;
  const double turns = std::round(angle / kRightAngle);
  if (std::abs(turns) < 1e6 &&
      std::abs(angle - turns * kRightAngle) <= kRightAngleTolerance * std::abs(angle)) {
    switch (static_cast<long>(turns) & 3) {
      case 0:
        return {0.0, 1.0};
      case 1:
        return {1.0, 0.0};
      case 2:
        return {0.0, -1.0};
      default:
        return {-1.0, 0.0};
    }
  }
  return {std::sin(angle), std::cos(angle)};
}

void check_finite(double value, const char* argument) {
  if (!std::isfinite(value)) {
    throw InvalidArgument(argument, text(value), "a finite number");
  }
}

}  // namespace

void check(const DhRow& row) {
  check_finite(row.d, "d");
  check_finite(row.theta, "theta");
  check_finite(row.a, "a");
  check_finite(row.alpha, "alpha");
  if (row.joint != JointType::kFixed) {
    check(row.joint, row.limits);
  }
}

SE3 dh_transform(double d, double theta, double a, double alpha) {
  const auto [st, ct] = exact_right_angles(theta);
  const auto [sa, ca] = exact_right_angles(alpha);
  SE3 T;
  T.rotation << ct, -ca * st, sa * st,  //
      st, ca * ct, -sa * ct,            //
      0.0, sa, ca;
  T.translation << a * ct, a * st, d;
  return T;
}

Segment to_segment(const DhRow& row) {
  return {row.frame, row.joint == JointType::kFixed ? "" : row.name,   row.joint,
          SE3{},     dh_transform(row.d, row.theta, row.a, row.alpha), row.limits};
}

}  // namespace thing_kin
