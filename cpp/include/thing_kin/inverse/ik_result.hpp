#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "thing_kin/model/chain.hpp"

namespace thing_kin {

/// How an inverse kinematics solve ended, whichever solver it was.
enum class IkStatus : std::uint8_t {
  kSuccess,      ///< within tolerance and limits, verified by forward kinematics
  kUnreachable,  ///< q is the closest pose found, and no joint limit holds it back
  kLimited,      ///< q is the closest pose found, and joint limits hold it back
  kStepBound,    ///< no solution within max_step of the seed
  kBudget,       ///< iterations ran out
  kDeadline,     ///< time ran out
};

/// "success", "unreachable", "limited", "step_bound", "budget", "deadline".
const char* to_string(IkStatus status);

/// A joint at a limit: -1 lower, 1 upper, 0 neither; in the order of q.
using ActiveLimits = std::array<std::int8_t, kMaxDof>;

/// What a solver found. q is always finite and within the limits, also where there is no success:
/// then it is the best configuration found.
struct IkResult {
  JointVector q;
  IkStatus status = IkStatus::kBudget;
  double position_error = 0.0;  ///< m, of the coordinates asked for
  double rotation_error = 0.0;  ///< rad, of the coordinates asked for
  ActiveLimits active_limits{};
  int iterations = 0;
  int restarts = 0;
  double time = 0.0;  ///< s

  bool success() const { return status == IkStatus::kSuccess; }
};

/// Which joints stand exactly at a limit.
ActiveLimits active_limits(const Chain& chain, const JointVector& q) noexcept;

/// In a sentence: "0.31 m beyond reach", "0.02 m and 0.1 rad away: joint 'elbow' at its upper
/// limit".
std::string message(const Chain& chain, const IkResult& result);

}  // namespace thing_kin
