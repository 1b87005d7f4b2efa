#include "thing_kin/odometry/differential_drive.hpp"

#include <cmath>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

double checked_drive_length(double value, const char* name) {
  if (!(std::isfinite(value) && value > 0.0)) {
    throw InvalidArgument(name, text(value), "a finite number > 0");
  }
  return value;
}

}  // namespace

DifferentialDriveOdometry::DifferentialDriveOdometry(double left_radius, double right_radius,
                                                     double track)
    : left_radius_(checked_drive_length(left_radius, "wheel_radius")),
      right_radius_(checked_drive_length(right_radius, "wheel_radius")),
      track_(checked_drive_length(track, "track")) {}

Twist2 DifferentialDriveOdometry::twist(const Eigen::Vector2d& wheel_speeds) const noexcept {
  const double left = left_radius_ * wheel_speeds[0];
  const double right = right_radius_ * wheel_speeds[1];
  return {0.5 * (left + right), 0.0, (right - left) / track_};
}

Eigen::Vector2d DifferentialDriveOdometry::wheel_speeds(const Twist2& twist) const noexcept {
  const double turn = 0.5 * track_ * twist.z();
  return {(twist.x() - turn) / left_radius_, (twist.x() + turn) / right_radius_};
}

}  // namespace thing_kin
