#pragma once

#include <array>
#include <cstdint>

#include "thing_kin/inverse/limits.hpp"
#include "thing_kin/inverse/step_limit.hpp"

namespace thing_kin {

/// What became of a limited step.
enum class StepStatus : std::uint8_t {
  kOptimal,         ///< every level is solved as well as limits and levels above allow
  kIterationLimit,  ///< limits and priorities hold, but a level may not be at its best
};
const char* to_string(StepStatus status);

/// One step within limits, and what it could do for each level.
struct LimitedStep {
  struct Level {
    SmallVector error;     ///< of the task, before its gain
    SmallVector residual;  ///< J dq - gain * error; of an interval: what is outside, signed
    std::array<std::int8_t, kMaxDof>
        active;  ///< of an interval's rows: at or beyond -1 lower, 1 upper
    bool interval = false;
  };

  JointVector dq;
  int count = 0;  ///< levels: the tasks
  std::array<Level, kMaxTasks> levels;
  std::array<std::int8_t, kMaxDof> active;  ///< dq is at -1: its lower, 1: its upper bound
  std::array<LimitKind, kMaxDof> kinds;     ///< what that bound comes from
  std::array<std::int8_t, 4> wheels{};      ///< the same for wheel speeds
  int iterations = 0;
  StepStatus status = StepStatus::kOptimal;
};

}  // namespace thing_kin
