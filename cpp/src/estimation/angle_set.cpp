#include "thing_kin/estimation/angle_set.hpp"

#include <bit>

#include "thing_kin/core/error.hpp"
#include "thing_kin/lie/se2.hpp"

namespace thing_kin {

AngleSet::AngleSet(std::span<const int> indices, int n) {
  for (const int i : indices) {
    const bool fits = i >= 0 && i < n && i < 32;
    if (!fits || (mask_ >> i & 1U) != 0) {
      throw InvalidArgument("angles", std::to_string(i),
                            "different indices from 0 to " + std::to_string(n - 1));
    }
    mask_ |= 1U << i;
  }
}

std::vector<int> AngleSet::indices() const {
  std::vector<int> found;
  for (std::uint32_t rest = mask_; rest != 0; rest &= rest - 1) {
    found.push_back(std::countr_zero(rest));
  }
  return found;
}

void AngleSet::wrap_angles(double* v) const noexcept {
  for (std::uint32_t rest = mask_; rest != 0; rest &= rest - 1) {
    double& angle = v[std::countr_zero(rest)];
    angle = wrap_angle(angle);
  }
}

}  // namespace thing_kin
