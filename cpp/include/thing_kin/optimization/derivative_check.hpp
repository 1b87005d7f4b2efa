#pragma once

#include "thing_kin/optimization/term.hpp"

namespace thing_kin {

/// The largest difference between a term's derivative and differences of what it derives from.
struct DerivativeDifference {
  double largest = 0.0;   ///< relative to the larger of 1 and the largest entry
  int entry = 0;          ///< of the term's value
  int row = 0;            ///< variable; of a Hessian its row
  int col = 0;            ///< of a Hessian its column
  double given = 0.0;     ///< by the term
  double expected = 0.0;  ///< by differences
};

struct DerivativeCheck {
  DerivativeDifference jacobian, hessian;
};

/// Compares the Jacobian with central differences of the value (two steps, extrapolated: error of
/// fourth order), and the Hessian of each entry with central differences of the Jacobian. Throws
/// InvalidArgument("x", ...) where the term does not exist at x or next to it.
DerivativeCheck check_derivatives(const Term& term, const VectorView& x);

}  // namespace thing_kin
