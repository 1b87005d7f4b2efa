#pragma once

#include "thing_kin/optimization/problem.hpp"

namespace thing_kin {

/// How near x is to a Karush-Kuhn-Tucker point, from the problem alone: nothing of a solver's.
struct Optimality {
  double violation = 0.0;             ///< the largest of a constraint or bound
  double residual = 0.0;              ///< the largest of stationarity and complementarity, relative
  Eigen::VectorXd multipliers;        ///< (m); > 0: at the upper bound
  Eigen::VectorXd bound_multipliers;  ///< (n); > 0: at the upper bound
};

/// Multipliers with the right signs that make the Lagrangian's gradient least, of the constraints
/// that are active within `activity` (relative to 1 and to the bound). The residual is what is left
/// of the gradient, relative to the largest of 1, the objective's gradient and the constraints'
/// pulls, or multiplier times slack relative to the first two. `at`: the linearization at x.
Optimality optimality(const Problem& problem, const VectorView& x, const Linearization& at,
                      double activity = 1e-6);

}  // namespace thing_kin
