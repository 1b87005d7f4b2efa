#include "thing_kin/optimization/sqp.hpp"

#include <algorithm>

#include "sqp_search.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/optimization/optimality.hpp"

namespace thing_kin {

namespace {

using Eigen::VectorXd;

constexpr std::size_t kViolationsNamed = 5;

std::string named(const std::vector<Violation>& violations) {
  std::string message;
  for (std::size_t i = 0; i < std::min(violations.size(), kViolationsNamed); ++i) {
    message.append(i == 0 ? "" : ", ").append(violations[i].name);
    message.append(" by ").append(text(violations[i].amount));
  }
  if (violations.size() > kViolationsNamed) {
    message.append(" and ").append(std::to_string(violations.size() - kViolationsNamed));
    message.append(" more");
  }
  return message;
}

// No x meets these, whatever the functions.
bool has_crossed_bounds(const Problem& problem) {
  return (problem.lower().array() > problem.upper().array()).any() ||
         (problem.row_lower().array() > problem.row_upper().array()).any();
}

// In the bounds; between crossed ones.
VectorXd start_of(const Problem& problem, const VectorView& x0) {
  VectorXd x = x0.cwiseMax(problem.lower()).cwiseMin(problem.upper());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (problem.lower()[i] > problem.upper()[i]) {
      x[i] = std::clamp(x0[i], problem.upper()[i], problem.lower()[i]);
    }
  }
  return x;
}

std::string explain(const SqpResult& result, const std::vector<Violation>& violations,
                    bool out_of_budget) {
  const std::string residual = std::string("KKT residual ").append(text(result.kkt_residual));
  if (result.status == SolveStatus::kInfeasible) {
    return std::string("infeasible: ").append(named(violations));
  }
  if (result.success()) {
    return std::string("converged: largest violation ")
        .append(text(result.constraint_violation))
        .append(", ")
        .append(residual);
  }
  return std::string(out_of_budget ? "out of budget: " : "no step improves the merit: ")
      .append(violations.empty() ? residual
                                 : std::string("violated are ").append(named(violations)));
}

// Nothing here is the search's own word but whether it ran out.
void judge(const Problem& problem, const SqpOptions& options, bool is_infeasible,
           bool out_of_budget, SqpResult& result) {
  Linearization at;
  if (!problem.linearize(result.x, at)) {
    result.objective = result.kkt_residual = std::numeric_limits<double>::infinity();
    result.constraint_violation = std::numeric_limits<double>::infinity();
    result.multipliers = VectorXd::Zero(problem.rows());
    result.bound_multipliers = VectorXd::Zero(problem.variables());
    result.message = quoted(problem.undefined_at(result.x)).append(" does not exist at x0");
    return;
  }
  Optimality found = optimality(problem, result.x, at);
  result.objective = at.objective;
  result.constraint_violation = found.violation;
  result.kkt_residual = found.residual;
  result.multipliers = std::move(found.multipliers);
  result.bound_multipliers = std::move(found.bound_multipliers);
  const auto violations = problem.violations(result.x, at.value, options.constraint_tolerance);
  if (!violations.empty()) {
    result.constraint_violation = violations.front().amount;
    result.status = is_infeasible ? SolveStatus::kInfeasible : SolveStatus::kBudget;
  } else if (found.residual <= options.optimality_tolerance) {
    result.status = SolveStatus::kConverged;
  }
  result.message = explain(result, violations, out_of_budget);
}

}  // namespace

SqpResult sqp(const Problem& problem, const VectorView& x0, const ConvexMinimizer& minimizer,
              const SqpOptions& options) {
  options.check();
  if (x0.size() != problem.variables()) {
    throw InvalidArgument("x0", std::to_string(x0.size()).append(" numbers"),
                          std::to_string(problem.variables()));
  }
  if (!x0.allFinite()) {
    throw InvalidArgument("x0", "a number that is not finite", "finite numbers");
  }
  SqpSearch search(problem, minimizer, options, start_of(problem, x0));
  bool is_infeasible = has_crossed_bounds(problem);
  if (!is_infeasible) {
    is_infeasible = !search.penalty_loop();
  }
  SqpResult result;
  result.x = search.x();
  judge(problem, options, is_infeasible, search.out_of_budget(), result);
  result.iterations = search.iterations();
  result.time = search.seconds();
  result.trace = std::move(search.trace());
  return result;
}

}  // namespace thing_kin
