#pragma once

#include <cstdint>
#include <string>

namespace thing_kin {

/// Which instructions the kinematics kernels use. All levels run the same source, and their results
/// agree to a few units in the last place.
enum class SimdLevel : std::uint8_t {
  kBaseline,  ///< what the compiler takes for granted: SSE2 on x86-64, NEON on AArch64
  kAvx2,      ///< AVX2 and FMA: four lanes
  kAvx512,    ///< AVX-512 F, DQ, BW and VL: eight lanes
};

/// "baseline", "avx2", "avx512".
const char* to_string(SimdLevel level);
SimdLevel simd_level_from_string(const std::string& name);

/// The best level of this processor among those built in.
SimdLevel best_simd_level() noexcept;

/// The level in use by all threads: the best, unless use_simd_level() chose another.
SimdLevel simd_level() noexcept;

/// Chooses a level, for tests and comparisons; throws InvalidArgument if this processor or build
/// does not have it.
void use_simd_level(SimdLevel level);

}  // namespace thing_kin
