#pragma once

#include <limits>
#include <string>
#include <vector>

#include "thing_kin/optimization/convex_model.hpp"
#include "thing_kin/optimization/problem.hpp"
#include "thing_kin/optimization/solve_status.hpp"

namespace thing_kin {

/// The constants of [M17] Algorithm 2, and when it ends.
struct SqpOptions {
  double c = 0.1;           ///< least ratio of actual to predicted improvement, in (0, 1)
  double tau_plus = 2.0;    ///< growth of the trust region where a step is accepted, > 1
  double tau_minus = 0.25;  ///< its shrinking where not, in (0, 1)
  double k = 10.0;          ///< growth of the penalty, > 1
  double mu0 = 10.0;        ///< first penalty
  double mu_max = 1e9;      ///< largest penalty
  double delta0 = 1.0;      ///< first radius of the trust region, in each variable
  double delta_min = 1e-12;
  double delta_max = 1e4;
  double step_tolerance = 1e-12;         ///< a largest entry of a step that counts as none
  double improvement_tolerance = 1e-15;  ///< of the merit, relative to it and to 1
  double constraint_tolerance = 1e-8;    ///< largest violation
  double optimality_tolerance = 1e-6;    ///< largest KKT residual, see optimality.hpp
  bool second_order_correction = true;   ///< try again with the constraints' values at the end
  int max_iterations = 500;              ///< convexified problems solved
  double deadline = std::numeric_limits<double>::infinity();  ///< s

  /// Throws InvalidArgument.
  void check() const;
};

/// What happened, a convexified problem each: values at the point from which its step was tried.
struct SqpTrace {
  std::vector<double> merit, objective, violation, radius, penalty;
  std::vector<bool> accepted;
};

struct SqpResult {
  Eigen::VectorXd x;
  SolveStatus status = SolveStatus::kBudget;
  std::string message;  ///< the status in a sentence
  double objective = 0.0;
  double constraint_violation = 0.0;  ///< the largest of a constraint or bound
  double kkt_residual = 0.0;          ///< see optimality.hpp
  Eigen::VectorXd multipliers;        ///< (m); > 0: at the upper bound
  Eigen::VectorXd bound_multipliers;  ///< (n)
  int iterations = 0;
  double time = 0.0;  ///< s
  SqpTrace trace;

  bool success() const { return status == SolveStatus::kConverged; }
};

/// [M17] Algorithm 2 with the errata: penalties on violations, raised in the outermost loop; steps
/// in a trust region that minimize a convex model, accepted by the exact l1 merit
///   f + mu sum |violation|.
/// Where a higher penalty does not help, the violation alone is minimized in the same way: this
/// either finds a feasible point or ends where no step lessens the violation, "infeasible".
/// The result is judged at its x by Problem and optimality() anew. x0: (n), brought into the bounds
/// first. Throws InvalidArgument("x0", ...), and what a term throws.
SqpResult sqp(const Problem& problem, const VectorView& x0, const ConvexMinimizer& minimizer,
              const SqpOptions& options = {});

}  // namespace thing_kin
