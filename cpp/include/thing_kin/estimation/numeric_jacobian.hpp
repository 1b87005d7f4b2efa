#pragma once

#include <functional>

#include "thing_kin/estimation/gaussian_filter.hpp"

namespace thing_kin {

/// out (m) <- a function at x (n).
using StateFunction = std::function<void(const double* x, double* out)>;

/// J (m, n), in rows, <- central differences; those of angles in `angles` are wrapped. The error is
/// about 1e-10 of the function's size. n of x, m the function's entries.
void numeric_jacobian(const StateFunction& function, const VectorView& x, int m,
                      const AngleSet& angles, double* J);

}  // namespace thing_kin
