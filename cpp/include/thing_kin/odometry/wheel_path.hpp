#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "thing_kin/lie/se2.hpp"

namespace thing_kin {

/// A motion between two times as mecanum wheels have measured it, with its derivatives by
/// (log R, log k, clock offset) and the spread of its error; small motions of its end, in the
/// body's axes.
struct WheelMotion {
  Pose2 pose = Pose2::Zero();
  Eigen::Matrix3d sensitivity = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double travel = 0.0;  ///< mean path of the four rims, m
  bool whole = true;    ///< no gap of the record inside that the robot has moved in
};

/// One motion after the other.
WheelMotion combine(const WheelMotion& first, const WheelMotion& second);

/// A record of mecanum wheels as motions of R = 1 m and k = 1 m, seen with other values.
class WheelPath {
 public:
  /// Stamps (not decreasing) and wheel angles fl, rl, rr, fr in rows of four.
  WheelPath(std::span<const double> t, std::span<const Eigen::Vector4d> angles, double longest_gap);

  /// Chooses R, k and the seconds that the wheels' clock is ahead of the caller's.
  void set(double wheel_radius, double k, double clock_offset);

  double first() const { return t_.front() - clock_offset_; }
  double last() const { return t_.back() - clock_offset_; }

  /// Dead-reckoned from zero at first().
  Pose2 pose_at(double t) const;

  /// `variance`: of x, y (m^2) and theta (rad^2) for each metre of travel.
  WheelMotion motion(double from, double to, const Eigen::Vector3d& variance) const;

 private:
  struct Step {
    Twist2 unit;  // for R = k = 1
    double travel;
  };
  std::size_t step_at(double stamp) const;
  double fraction(std::size_t step, double stamp) const;
  Twist2 scaled(const Twist2& unit) const;
  Twist2 velocity_at(double stamp) const;
  void add(std::size_t step, double part, const Eigen::Vector3d& variance, WheelMotion& to) const;

  std::vector<double> t_;
  std::vector<Step> steps_;
  std::vector<Pose2> poses_;
  double longest_gap_;
  double wheel_radius_ = 1.0;
  double k_ = 1.0;
  double clock_offset_ = 0.0;
};

}  // namespace thing_kin
