#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

#include "thing_kin/lie/se2.hpp"

namespace thing_kin {

/// Where a robot's own list of wheels has the front left, rear left, rear right and front right
/// one, which is the order of [M17] (3.20).
class WheelOrder {
 public:
  WheelOrder() = default;

  /// A permutation of "fl", "rl", "rr", "fr"; throws InvalidArgument naming `order`.
  explicit WheelOrder(const std::array<std::string, 4>& names);

  /// From the robot's list to (fl, rl, rr, fr), and back.
  Eigen::Vector4d sorted(const Eigen::Vector4d& wheels) const noexcept;
  Eigen::Vector4d listed(const Eigen::Vector4d& sorted) const noexcept;

  std::array<std::string, 4> names() const;

  bool operator==(const WheelOrder&) const = default;

 private:
  std::array<int, 4> place_{0, 1, 2, 3};
};

/// Four mecanum wheels, [M17] (3.20). Wheel speeds in rad/s, positive forwards.
class MecanumOdometry {
 public:
  /// wheel_radius in m; k, half the wheel base plus half the track, in m. Both finite and > 0.
  MecanumOdometry(double wheel_radius, double k, const WheelOrder& order = {});

  /// Twist of the body that explains the wheel speeds best (least squares), [M17] (3.20).
  Twist2 twist(const Eigen::Vector4d& wheel_speeds) const noexcept;

  /// Wheel speeds that roll without slipping at this twist.
  Eigen::Vector4d wheel_speeds(const Twist2& twist) const noexcept;

  /// R/4 (fl - rl - rr + fr), m/s: what four wheels say beyond the three numbers of a twist. It is
  /// zero while all roll; wheel i's rim slips by it, times (1, -1, -1, 1), at least.
  double slip(const Eigen::Vector4d& wheel_speeds) const noexcept;

  double wheel_radius() const { return wheel_radius_; }
  double k() const { return k_; }
  const WheelOrder& order() const { return order_; }

  bool operator==(const MecanumOdometry&) const = default;

 private:
  double wheel_radius_;
  double k_;
  WheelOrder order_;
};

/// Columns fl, rl, rr, fr of (3.20) for R = 1 m and k = 1 m.
Eigen::Matrix<double, 3, 4> unit_mecanum_matrix();

}  // namespace thing_kin
