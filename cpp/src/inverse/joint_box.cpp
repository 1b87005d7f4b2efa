#include "thing_kin/inverse/joint_box.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace thing_kin {

namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;

// from + step, rounded so that the way back is no longer than the step in floating point too.
double within(double from, double step) noexcept {
  double to = from + step;
  while (std::isfinite(to) && std::abs(to - from) > std::abs(step)) {
    to = std::nextafter(to, from);
  }
  return to;
}

}  // namespace

JointBox::JointBox(const Chain& chain) noexcept : lower_(chain.lower()), upper_(chain.upper()) {
  for (std::size_t j = 0; std::cmp_less(j, chain.dof()); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    rotary_[j] = thing_kin::is_rotary(chain.joint_types()[j]);
    endless_[j] = rotary_[j] && upper_[i] - lower_[i] >= kWholeTurn;
  }
}

void JointBox::keep_near(const JointVector& seed, const JointVector& max_step) noexcept {
  for (Eigen::Index j = 0; j < lower_.size(); ++j) {
    lower_[j] = std::max(lower_[j], within(seed[j], -max_step[j]));
    upper_[j] = std::min(upper_[j], within(seed[j], max_step[j]));
    const auto i = static_cast<std::size_t>(j);
    endless_[i] = endless_[i] && upper_[j] - lower_[j] >= kWholeTurn;
  }
}

void JointBox::narrow(Eigen::Index j, double lower, double upper) noexcept {
  lower_[j] = std::max(lower_[j], lower);
  upper_[j] = std::min(upper_[j], upper);
  const auto i = static_cast<std::size_t>(j);
  endless_[i] = endless_[i] && upper_[j] - lower_[j] >= kWholeTurn;
}

double JointBox::inside(Eigen::Index j, double x) const noexcept {
  if (x >= lower_[j] && x <= upper_[j]) {
    return x;
  }
  if (is_endless(j)) {
    const double past = x < lower_[j] ? lower_[j] - x : upper_[j] - x;
    x += std::copysign(kWholeTurn * std::ceil(std::abs(past) / kWholeTurn), past);
  }
  return std::clamp(x, lower_[j], upper_[j]);
}

bool JointBox::contains(const JointVector& q) const noexcept {
  return (q.array() >= lower_.array()).all() && (q.array() <= upper_.array()).all();
}

void JointBox::wind_towards(const JointVector& seed, JointVector& q) const noexcept {
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    if (!is_endless(j)) {
      continue;
    }
    // A limit may be in the way of the nearest image, but since the seed is within the limits not
    // of the one before it.
    const double turns = std::round((seed[j] - q[j]) / kWholeTurn);
    for (const double less : {0.0, 1.0}) {
      const double x = q[j] + (turns - std::copysign(less, turns)) * kWholeTurn;
      if (x >= lower_[j] && x <= upper_[j]) {
        q[j] = x;
        break;
      }
    }
  }
}

}  // namespace thing_kin
