#include "thing_kin/model/joint_difference.hpp"

#include <cmath>
#include <numbers>

namespace thing_kin {

namespace {

constexpr double kPi = std::numbers::pi;

// An angle less than a turn outside of [-pi, pi), put inside.
double into_range(double angle) {
  if (angle >= kPi) {
    return angle - 2 * kPi;
  }
  return angle < -kPi ? angle + 2 * kPi : angle;
}

// to - from with the part that the subtraction rounds off (Knuth's two-sum): at a thousand turns
// that part is 1e-12, the error of a result of some radians only 1e-16.
double continuous_difference(double from, double to) {
  const double difference = to - from;
  const double of_from = to - difference;
  const double of_to = difference + of_from;
  const double rounded_off = (to - of_to) + (of_from - from);
  return into_range(shortest_turn(difference) + shortest_turn(rounded_off));
}

}  // namespace

double shortest_turn(double angle) noexcept {
  if (angle >= -kPi && angle < kPi) {
    return angle;
  }
  return into_range(std::atan2(std::sin(angle), std::cos(angle)));
}

void joint_difference(const Chain& chain, const double* from, const double* to,
                      double* difference) noexcept {
  for (int i = 0; i < chain.dof(); ++i) {
    const bool turns_freely =
        chain.joint_types()[static_cast<std::size_t>(i)] == JointType::kContinuous;
    difference[i] = turns_freely ? continuous_difference(from[i], to[i]) : to[i] - from[i];
  }
}

}  // namespace thing_kin
