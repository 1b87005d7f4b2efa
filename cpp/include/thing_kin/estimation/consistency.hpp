#pragma once

#include "thing_kin/estimation/angle_set.hpp"

namespace thing_kin {

/// Normalized estimation error squared, e^T P^-1 e with e = truth - x, angles wrapped. NaN where P
/// (n, n) is not positive definite. n is at most 16.
double normalized_error_squared(const double* truth, const double* x, const double* P, int n,
                                const AngleSet& angles) noexcept;

}  // namespace thing_kin
