#pragma once

#include <cstdint>

namespace thing_kin {

/// How an optimization ended: a contract on the x that comes with it.
enum class SolveStatus : std::uint8_t {
  kConverged,   ///< feasible and stationary, both within tolerance
  kInfeasible,  ///< constraints are violated, and no step lessens the violation
  kBudget,      ///< iterations or time ran out: x is the best point found, feasible or not
};

/// "converged", "infeasible", "budget".
constexpr const char* to_string(SolveStatus status) noexcept {
  switch (status) {
    case SolveStatus::kConverged:
      return "converged";
    case SolveStatus::kInfeasible:
      return "infeasible";
    default:
      return "budget";
  }
}

}  // namespace thing_kin
