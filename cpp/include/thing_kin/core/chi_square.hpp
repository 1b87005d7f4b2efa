#pragma once

namespace thing_kin {

/// P(X <= x) of a chi-square variable with `dof` degrees of freedom, dof >= 1.
double chi_square_probability(double x, int dof);

/// The x that a chi-square variable with `dof` degrees of freedom stays below with `probability`:
/// what turns a gate given as a probability into a bound of the squared Mahalanobis distance.
/// Infinite for 1. Throws InvalidArgument unless 0 <= probability <= 1 and 1 <= dof <= 10^6.
double chi_square_quantile(double probability, int dof);

}  // namespace thing_kin
