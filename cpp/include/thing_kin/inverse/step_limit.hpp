#pragma once

#include <array>

#include "thing_kin/core/types.hpp"

namespace thing_kin {

inline constexpr int kMaxTasks = 16;

/// One step, and what each level had to do with it. Level `tasks` is the free null-space motion.
struct TaskPriorityStep {
  struct Level {
    JointVector contribution;  ///< before the step limit, in the null space of the levels above
    double scale = 1.0;        ///< what the step limit left of it, [0, 1]
    SmallVector error;         ///< of the task, before its gain
  };

  JointVector dq;  ///< sum of scale * contribution
  int count = 0;   ///< levels
  std::array<Level, kMaxTasks + 1> levels;
};

/// Chooses the levels' scales so that no |dq_j| exceeds its limit: whole contributions are kept
/// from the highest priority down, the first that does not fit is shortened, and those below get
/// what room is left. The direction of no level changes, so that priorities stay strict.
void scale_to_limit(const JointVector& limit, TaskPriorityStep& step) noexcept;

}  // namespace thing_kin
