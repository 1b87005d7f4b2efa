#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "thing_kin/inverse/differential_inverse.hpp"
#include "thing_kin/inverse/limited_step.hpp"
#include "thing_kin/inverse/set_task.hpp"
#include "thing_kin/inverse/step_limit.hpp"
#include "thing_kin/inverse/task.hpp"
#include "thing_kin/linalg/singular_value_filter.hpp"

namespace thing_kin {

struct LimitedProblem;

/// How the tasks' steps are put together.
enum class Scheme : std::uint8_t {
  kNakamura,    ///< [M17] (4.16): one or two tasks
  kSiciliano,   ///< Siciliano & Slotine (1991): any number of tasks
  kChiaverini,  ///< [M17] (4.17): robust at algorithmic singularities, only approximately optimal
};

Scheme scheme_from_string(const std::string& name);
const char* to_string(Scheme scheme);

struct TaskPriorityOptions {
  Scheme scheme = Scheme::kChiaverini;
  DifferentialInverse inverse{SelectivelyDamped()};
  std::optional<SingularValueFilter> filter;
  /// Largest |dq_j| of a step, one a joint; empty: none.
  std::optional<JointVector> step_limit;
  /// Bounded least squares instead of the schemes' formulas; empty: only step_limit is kept.
  std::optional<LimitOptions> limits = std::nullopt;

  /// What suits limits: the recursion that bounded least squares is, damped.
  static TaskPriorityOptions limited(LimitOptions limits);
};

/// Prioritized inverse differential kinematics, [M17] 4.3. Immutable: any number of threads may use
/// one solver; solve() allocates nothing.
///
/// A lower task never disturbs a higher one: it moves in the exact null space of all above it,
/// whatever regularization the inverse has (erratum to (4.15)-(4.18)).
class TaskPriority {
 public:
  /// Throws InvalidArgument: no task or too many, a scheme that can't take them, an unknown frame,
  /// a base task without a base, a step limit of the wrong size or not positive; without limits a
  /// set-based task; with them 'chiaverini' or SelectivelyDamped, which minimize nothing.
  TaskPriority(Chain chain, std::vector<std::shared_ptr<const Task>> tasks,
               TaskPriorityOptions options);

  const Chain& chain() const { return chain_; }
  const std::vector<std::shared_ptr<const Task>>& tasks() const { return tasks_; }
  const TaskPriorityOptions& options() const { return options_; }

  /// q: chain.dof() finite entries. targets: one pointer a task, see Task::target_shape.
  /// null_motion: dof() entries to be projected into what the tasks leave free, or nullptr.
  void solve(const double* q, std::span<const double* const> targets, const double* null_motion,
             TaskPriorityStep& step) const noexcept;

  /// As solve(), within the chain's position, velocity and acceleration limits, the options' limits
  /// and the intervals of set-based tasks: each level in least squares, in strict order. previous:
  /// the step before, or nullptr for no limit on the acceleration. For a solver with limits.
  void solve_limited(const double* q, std::span<const double* const> targets,
                     const double* null_motion, const double* previous,
                     LimitedStep& step) const noexcept;

  /// dq of solve_limited() alone, as quickly as can be.
  StepStatus step_limited(const double* q, std::span<const double* const> targets,
                          const double* null_motion, const double* previous,
                          JointVector& dq) const noexcept;

  /// Singular values of the matrix that each task inverts, before any filter. sigma: one a task.
  void singular_values(const double* q, std::span<const double* const> targets,
                       std::span<SmallVector> sigma) const noexcept;

 private:
  void check_limits() const;
  void pose_level(std::size_t i, const Posture& posture, const double* q, const double* target,
                  LimitedProblem& problem) const noexcept;
  void pose(const double* q, std::span<const double* const> targets, const double* null_motion,
            const double* previous, LimitedProblem& problem) const noexcept;
  void add_level(int index, const TaskValue& value, const SmallMatrix& Z, bool need_null_space,
                 TaskPriorityStep& step, SmallMatrix& next_Z) const noexcept;

  Chain chain_;
  std::vector<std::shared_ptr<const Task>> tasks_;
  std::vector<int> frames_;
  std::vector<const SetTask*> sets_;  // of each task; nullptr if it is none
  TaskPriorityOptions options_;
};

}  // namespace thing_kin
