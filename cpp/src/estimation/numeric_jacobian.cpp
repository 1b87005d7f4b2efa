#include "thing_kin/estimation/numeric_jacobian.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "thing_kin/core/tolerance.hpp"

namespace thing_kin {

void numeric_jacobian(const StateFunction& function, const VectorView& x, int m,
                      const AngleSet& angles, double* J) {
  const auto n = static_cast<int>(x.size());
  StateVector at = x;
  std::array<double, static_cast<std::size_t>(kMaxState)> plus{};
  std::array<double, static_cast<std::size_t>(kMaxState)> minus{};
  for (int j = 0; j < n; ++j) {
    // The cube root of the rounding error balances it with the error of third order.
    const double step = std::cbrt(kEpsilon) * std::max(1.0, std::abs(x[j]));
    at[j] = x[j] + step;
    const double above = at[j];
    function(at.data(), plus.data());
    at[j] = x[j] - step;
    const double between = above - at[j];
    function(at.data(), minus.data());
    at[j] = x[j];
    angles.difference(plus.data(), minus.data(), plus.data(), m);
    for (int i = 0; i < m; ++i) {
      J[i * n + j] = plus[static_cast<std::size_t>(i)] / between;
    }
  }
}

}  // namespace thing_kin
