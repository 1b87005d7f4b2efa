#include "thing_kin/odometry/encoder.hpp"

#include <cmath>

namespace thing_kin {

void unwrap_ticks(std::span<double> ticks, std::size_t stride, double range) noexcept {
  for (std::size_t first = 0; first < stride && first < ticks.size(); ++first) {
    double before = ticks[first];
    for (std::size_t i = first + stride; i < ticks.size(); i += stride) {
      const double step = std::remainder(ticks[i] - before, range);
      before = ticks[i];
      ticks[i] = ticks[i - stride] + step;
    }
  }
}

}  // namespace thing_kin
