#include "thing_kin/estimation/consistency.hpp"

#include <array>
#include <limits>

#include "thing_kin/estimation/gaussian_filter.hpp"
#include "thing_kin/linalg/symmetric_kernels.hpp"

namespace thing_kin {

double normalized_error_squared(const double* truth, const double* x, const double* P, int n,
                                const AngleSet& angles) noexcept {
  std::array<double, static_cast<std::size_t>(kMaxState)> e;
  std::array<double, static_cast<std::size_t>(kMaxState) * kMaxState> L;
  angles.difference(truth, x, e.data(), n);
  if (!kernels::cholesky<0>(P, L.data(), n)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double pivot = L[at * static_cast<std::size_t>(n) + at];
    if (!(pivot > 0.0)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    e[at] /= pivot;
    for (int k = i + 1; k < n; ++k) {
      e[static_cast<std::size_t>(k)] -= L[static_cast<std::size_t>(i * n + k)] * e[at];
    }
    sum += e[at] * e[at];
  }
  return sum;
}

}  // namespace thing_kin
