#pragma once

#include "thing_kin/core/types.hpp"
#include "thing_kin/model/chain.hpp"

namespace thing_kin {

/// log sqrt(kappa/M), [M17] (4.33), with exact first and second derivatives by q: it has the
/// minimizers of sqrt(kappa/M) and is far tamer.
///
/// With the eigenvalues l_1 >= ... >= l_6 of A = J W J^T it is -(log det A - log l_1 + log l_6)/4,
/// so that only l_1 and l_6 need to be simple.
struct LogDexterity {
  double value;  ///< infinite where the Jacobian has lost rank
  JointVector gradient;
  SmallMatrix hessian;  ///< (n, n), or (k, k) along k directions

  double log_condition_number;  ///< log kappa, [M17] (4.32)
  double log_manipulability;    ///< log M, [M17] (4.30)
};

/// How much each measure counts in w_kappa log kappa - w_M log M.
struct DexterityWeights {
  double condition_number = 0.5;
  double manipulability = 0.5;
};

/// J: the world-aligned Jacobian of a frame's origin. column_weights: (n), at least 0, a factor of
/// each column of J, or null for ones; zeros leave joints out (the base's: the arm alone).
///
/// False, with an infinite value and the rest undefined, where the rank is lost. Where the largest
/// or smallest singular value is not simple, kappa has no derivative: that of a function next to it
/// is given.
bool log_dexterity(const Chain& chain, const Jacobian& J, const double* column_weights,
                   LogDexterity& out, const DexterityWeights& weights = {}) noexcept;

/// The same, but with the Hessian along the columns of Z (n, k) only: Z^T H Z (k, k), at a fraction
/// of the cost where k is small.
bool log_dexterity_along(const Chain& chain, const Jacobian& J, const SmallMatrix& Z,
                         const double* column_weights, LogDexterity& out,
                         const DexterityWeights& weights = {}) noexcept;

/// The value alone.
double log_dexterity(const Jacobian& J, const double* column_weights) noexcept;

/// At least the value, and at most log(6)/16 = 0.112 above it (some hundredths as a rule), at a
/// fraction of the cost: to rank many configurations. With the traces of A^8 and A^-8 in place of
/// l_1^8 and l_6^-8.
double log_dexterity_bound(const Jacobian& J, const double* column_weights) noexcept;

}  // namespace thing_kin
