#pragma once

#include <Eigen/Core>

#include "thing_kin/lie/se2.hpp"

namespace thing_kin {

/// Two driven wheels on one axle (the Pioneer LX of [X21]); not in the theses. Wheel speeds are
/// (left, right) in rad/s, positive forwards; the twist's vy is zero.
class DifferentialDriveOdometry {
 public:
  /// Radii in m; track, the distance between the wheels' contact points, in m. All finite and > 0.
  DifferentialDriveOdometry(double left_radius, double right_radius, double track);

  /// Twist of the middle of the axle.
  Twist2 twist(const Eigen::Vector2d& wheel_speeds) const noexcept;

  /// Wheel speeds of a twist; its vy, which no wheel can give, is ignored.
  Eigen::Vector2d wheel_speeds(const Twist2& twist) const noexcept;

  double left_radius() const { return left_radius_; }
  double right_radius() const { return right_radius_; }
  double track() const { return track_; }

  bool operator==(const DifferentialDriveOdometry&) const = default;

 private:
  double left_radius_;
  double right_radius_;
  double track_;
};

}  // namespace thing_kin
