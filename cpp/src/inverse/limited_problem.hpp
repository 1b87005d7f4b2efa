#pragma once

#include <array>

#include "thing_kin/inverse/limited_step.hpp"
#include "thing_kin/inverse/limits.hpp"
#include "thing_kin/inverse/task.hpp"
#include "thing_kin/linalg/regularized_rows.hpp"

namespace thing_kin {

/// A step as linear levels in a box.
struct LimitedProblem {
  LimitedProblem() {}  // what is not used is not touched: the levels alone are 140 kB

  struct Level {
    bool interval;
    TaskValue value;           // J and error of the task
    SmallVector wanted;        // J dq of a task
    SmallVector lower, upper;  // of J dq, an interval's
  };
  int joints = 0;
  int count = 0;
  union {
    std::array<Level, kMaxTasks> levels;
  };
  StepBox box;
  SmallMatrix wheel_rows;  // none or four
  SmallVector wheel_limit;
  const double* wish = nullptr;  // the null-space motion
  Regularization regularization;
};

/// The bounded step.
StepStatus solve(const LimitedProblem& problem, JointVector& dq, int& iterations) noexcept;

/// What is active at step.dq, and what each level misses.
void explain(const LimitedProblem& problem, LimitedStep& step) noexcept;

}  // namespace thing_kin
