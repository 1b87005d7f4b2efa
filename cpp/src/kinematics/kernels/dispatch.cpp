#include "kernels.hpp"
#include "thing_kin/core/simd.hpp"
#include "thing_kin/core/tolerance.hpp"

namespace thing_kin {

static_assert(Kernels::kHalfTurnTolerance == kHalfTurnTolerance);

namespace baseline {
extern const Kernels kKernels;
}
#ifdef THING_KIN_X86_KERNELS
namespace avx2 {
extern const Kernels kKernels;
}
namespace avx512 {
extern const Kernels kKernels;
}
#endif

const Kernels& kernels() noexcept {
#ifdef THING_KIN_X86_KERNELS
  switch (simd_level()) {
    case SimdLevel::kAvx512:
      return avx512::kKernels;
    case SimdLevel::kAvx2:
      return avx2::kKernels;
    case SimdLevel::kBaseline:
      break;
  }
#endif
  return baseline::kKernels;
}

}  // namespace thing_kin
