#include "thing_kin/odometry/mecanum.hpp"

#include <algorithm>
#include <cmath>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

constexpr std::array<const char*, 4> kWheelNames{"fl", "rl", "rr", "fr"};

[[noreturn]] void refuse_order(const std::array<std::string, 4>& names) {
  std::string got(1, '(');
  for (const std::string& name : names) {
    got.append(got.size() > 1 ? ", " : "").append(quoted(name));
  }
  throw InvalidArgument("order", got.append(")"), "each of 'fl', 'rl', 'rr', 'fr' once");
}

double checked_mecanum_length(double value, const char* name) {
  if (!(std::isfinite(value) && value > 0.0)) {
    throw InvalidArgument(name, text(value), "a finite number > 0");
  }
  return value;
}

}  // namespace

WheelOrder::WheelOrder(const std::array<std::string, 4>& names) {
  for (std::size_t wheel = 0; wheel < 4; ++wheel) {
    const auto* const found = std::ranges::find(names, kWheelNames[wheel]);
    if (found == names.end()) {
      refuse_order(names);
    }
    place_[wheel] = static_cast<int>(found - names.begin());
  }
}

Eigen::Vector4d WheelOrder::sorted(const Eigen::Vector4d& wheels) const noexcept {
  return {wheels[place_[0]], wheels[place_[1]], wheels[place_[2]], wheels[place_[3]]};
}

Eigen::Vector4d WheelOrder::listed(const Eigen::Vector4d& sorted) const noexcept {
  Eigen::Vector4d wheels;
  for (int i = 0; i < 4; ++i) {
    wheels[place_[static_cast<std::size_t>(i)]] = sorted[i];
  }
  return wheels;
}

std::array<std::string, 4> WheelOrder::names() const {
  std::array<std::string, 4> names;
  for (std::size_t i = 0; i < 4; ++i) {
    names[static_cast<std::size_t>(place_[i])] = kWheelNames[i];
  }
  return names;
}

Eigen::Matrix<double, 3, 4> unit_mecanum_matrix() {
  Eigen::Matrix<double, 3, 4> M;
  M << 1.0, 1.0, 1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, -1.0, 1.0, 1.0;
  return M / 4.0;
}

MecanumOdometry::MecanumOdometry(double wheel_radius, double k, const WheelOrder& order)
    : wheel_radius_(checked_mecanum_length(wheel_radius, "wheel_radius")),
      k_(checked_mecanum_length(k, "k")),
      order_(order) {}

Twist2 MecanumOdometry::twist(const Eigen::Vector4d& wheel_speeds) const noexcept {
  const Eigen::Vector4d w = wheel_radius_ / 4.0 * order_.sorted(wheel_speeds);
  return {w[0] + w[1] + w[2] + w[3], -w[0] + w[1] - w[2] + w[3], (-w[0] - w[1] + w[2] + w[3]) / k_};
}

Eigen::Vector4d MecanumOdometry::wheel_speeds(const Twist2& twist) const noexcept {
  const double x = twist.x() / wheel_radius_;
  const double y = twist.y() / wheel_radius_;
  const double turn = k_ * twist.z() / wheel_radius_;
  return order_.listed({x - y - turn, x + y - turn, x - y + turn, x + y + turn});
}

double MecanumOdometry::slip(const Eigen::Vector4d& wheel_speeds) const noexcept {
  const Eigen::Vector4d w = order_.sorted(wheel_speeds);
  return wheel_radius_ / 4.0 * (w[0] - w[1] - w[2] + w[3]);
}

}  // namespace thing_kin
