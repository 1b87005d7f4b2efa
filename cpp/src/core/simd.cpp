#include "thing_kin/core/simd.hpp"

#include <atomic>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

constexpr SimdLevel kLevels[] = {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512};

SimdLevel detect() noexcept {
#ifdef THING_KIN_X86_KERNELS
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
    return wide ? SimdLevel::kAvx512 : SimdLevel::kAvx2;
  }
#endif
  return SimdLevel::kBaseline;
}

std::atomic<SimdLevel>& current() noexcept {
  static std::atomic<SimdLevel> level{best_simd_level()};
  return level;
}

}  // namespace

const char* to_string(SimdLevel level) {
  switch (level) {
    case SimdLevel::kAvx2:
      return "avx2";
    case SimdLevel::kAvx512:
      return "avx512";
    case SimdLevel::kBaseline:
      break;
  }
  return "baseline";
}

SimdLevel simd_level_from_string(const std::string& name) {
  for (const SimdLevel level : kLevels) {
    if (name == to_string(level)) {
      return level;
    }
  }
  throw InvalidArgument("level", quoted(name), "'baseline', 'avx2' or 'avx512'");
}

SimdLevel best_simd_level() noexcept {
  static const SimdLevel best = detect();
  return best;
}

SimdLevel simd_level() noexcept { return current().load(std::memory_order_relaxed); }

void use_simd_level(SimdLevel level) {
  if (level > best_simd_level()) {
    throw InvalidArgument("level", quoted(to_string(level)),
                          std::string("at most ").append(quoted(to_string(best_simd_level()))));
  }
  current().store(level, std::memory_order_relaxed);
}

}  // namespace thing_kin
