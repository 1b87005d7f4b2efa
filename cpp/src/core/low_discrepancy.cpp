#include "thing_kin/core/low_discrepancy.hpp"

#include <cmath>
#include <utility>

namespace thing_kin {

namespace {

// phi^(n+1) = phi + 1 by Newton's method from above, where it converges monotonically.
double generalized_golden_ratio(int n) {
  double phi = 2.0;
  for (int i = 0; i < 8; ++i) {
    const double power = std::pow(phi, n);
    phi -= (power * phi - phi - 1.0) / ((n + 1) * power - 1.0);
  }
  return phi;
}

// One step of SplitMix64 (Steele, Lea & Flood 2014): neighboring seeds give unrelated numbers.
std::uint64_t mixed(std::uint64_t& state) {
  state += 0x9E3779B97F4A7C15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

// The fraction as 64 binary digits behind the point.
std::uint64_t as_digits(double fraction) { return static_cast<std::uint64_t>(fraction * 0x1p64); }

}  // namespace

LowDiscrepancy::LowDiscrepancy(int dimensions, std::uint64_t seed) noexcept {
  const double ratio = 1.0 / generalized_golden_ratio(dimensions);
  double alpha = 1.0;
  std::uint64_t state = seed;
  for (std::size_t j = 0; std::cmp_less(j, dimensions); ++j) {
    alpha *= ratio;
    alpha_[j] = as_digits(alpha);
    start_[j] = mixed(state);
  }
}

}  // namespace thing_kin
