#include "thing_kin/core/finite.hpp"

#include <bit>
#include <cstdint>

namespace thing_kin {

// NaN and infinity have an exponent of ones only, and one more carries into the sign's place. On
// whole numbers the loop is vectorized, as sums of floating-point numbers must not be.
bool all_finite(const double* numbers, std::size_t count) noexcept {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000;
  constexpr std::uint64_t kOne = 0x0010000000000000;
  std::uint64_t carries = 0;
  for (std::size_t i = 0; i < count; ++i) {
    carries |= (std::bit_cast<std::uint64_t>(numbers[i]) & kExponent) + kOne;
  }
  return carries >> 63 == 0;
}

}  // namespace thing_kin
