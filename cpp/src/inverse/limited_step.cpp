#include "thing_kin/inverse/limited_step.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "limited_problem.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/inverse/task_priority.hpp"
#include "thing_kin/linalg/hierarchical_qp.hpp"

namespace thing_kin {

namespace {

// Where an error is so large that squares could overflow, only its direction counts.
constexpr double kLargestError = 1e100;
SmallVector wanted_of(double gain, const SmallVector& error) {
  const double largest = error.cwiseAbs().maxCoeff();
  return error * (largest > kLargestError / gain ? kLargestError / largest : gain);
}

}  // namespace

const char* to_string(StepStatus status) {
  return status == StepStatus::kOptimal ? "optimal" : "iteration_limit";
}

TaskPriorityOptions TaskPriorityOptions::limited(LimitOptions limits) {
  TaskPriorityOptions options;
  options.scheme = Scheme::kSiciliano;
  options.inverse = Damped(1e-4);
  options.limits = limits;
  return options;
}

void TaskPriority::check_limits() const {
  int rows = options_.limits && options_.limits->wheels ? 4 : 0;
  for (std::size_t i = 0; i < sets_.size(); ++i) {
    if (sets_[i] != nullptr && !options_.limits) {
      throw InvalidArgument("tasks", std::string(tasks_[i]->kind()) + " without limits",
                            "limits=True with set-based tasks");
    }
    rows += sets_[i] != nullptr ? tasks_[i]->rows(chain_) : 0;
  }
  if (!options_.limits) {
    return;
  }
  if (rows > kMaxIntervalRows) {
    throw InvalidArgument("tasks", std::to_string(rows) + " rows of intervals and wheels",
                          "at most " + std::to_string(kMaxIntervalRows));
  }
  if (options_.limits->wheels && !chain_.base_joints()) {
    throw InvalidArgument("wheel_limits", quoted(chain_.name()),
                          "a robot on an omnidirectional base (on_omni_base)");
  }
  if (options_.scheme == Scheme::kChiaverini) {
    throw InvalidArgument("scheme", quoted(to_string(options_.scheme)).append(" with limits"),
                          "'siciliano' or 'nakamura', which are least squares");
  }
  if (std::holds_alternative<SelectivelyDamped>(options_.inverse)) {
    throw InvalidArgument("inverse", "SelectivelyDamped with limits",
                          "Exact or Damped, which are least squares");
  }
}

void TaskPriority::pose_level(std::size_t i, const Posture& posture, const double* q,
                              const double* target, LimitedProblem& problem) const noexcept {
  LimitedProblem::Level& level = *std::construct_at(&problem.levels[i]);
  level.interval = sets_[i] != nullptr;
  const double gain = tasks_[i]->gain();
  if (!level.interval) {
    tasks_[i]->evaluate(chain_, posture, frames_[i], q, target, level.value);
    level.wanted = wanted_of(gain, level.value.error);
    return;
  }
  IntervalValue interval;
  sets_[i]->evaluate_interval(chain_, posture, frames_[i], q, target, interval);
  // All the room that there is inside; of what is outside the gain's share back.
  const auto share = [gain](double way) { return way > 0.0 ? gain * way : way; };
  level.value.jacobian = interval.jacobian;
  level.value.error =
      interval.value.cwiseMax(interval.lower).cwiseMin(interval.upper) - interval.value;
  level.lower = (interval.lower - interval.value).unaryExpr(share);
  level.upper = -(interval.value - interval.upper).unaryExpr(share);
}

void TaskPriority::pose(const double* q, std::span<const double* const> targets,
                        const double* null_motion, const double* previous,
                        LimitedProblem& problem) const noexcept {
  Posture posture;
  place_joints(chain_, q, posture);
  problem.count = static_cast<int>(tasks_.size());
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    pose_level(i, posture, q, targets[i], problem);
  }
  problem.joints = chain_.dof();
  problem.wish = null_motion;
  const auto* damped = std::get_if<Damped>(&options_.inverse);
  problem.regularization.damping = damped != nullptr ? damped->damping : 0.0;
  problem.regularization.filter = options_.filter ? &*options_.filter : nullptr;
  problem.wheel_rows.resize(0, 0);
  const LimitOptions& limits = *options_.limits;
  step_box(chain_, q, previous, options_.step_limit ? options_.step_limit->data() : nullptr,
           limits.dt, problem.box);
  if (limits.wheels) {
    const auto& base = *chain_.base_joints();
    const Eigen::Matrix<double, 4, 3> rows = limits.wheels->rows(q[base[2]]);
    problem.wheel_rows.setZero(4, chain_.dof());
    for (int axis = 0; axis < 3; ++axis) {
      problem.wheel_rows.col(base[static_cast<std::size_t>(axis)]) = rows.col(axis);
    }
    problem.wheel_limit.setConstant(4, limits.wheels->speed * limits.dt);
  }
}

StepStatus TaskPriority::step_limited(const double* q, std::span<const double* const> targets,
                                      const double* null_motion, const double* previous,
                                      JointVector& dq) const noexcept {
  LimitedProblem problem;
  pose(q, targets, null_motion, previous, problem);
  int iterations = 0;
  return thing_kin::solve(problem, dq, iterations);
}

void TaskPriority::solve_limited(const double* q, std::span<const double* const> targets,
                                 const double* null_motion, const double* previous,
                                 LimitedStep& step) const noexcept {
  LimitedProblem problem;
  pose(q, targets, null_motion, previous, problem);
  step.status = thing_kin::solve(problem, step.dq, step.iterations);
  thing_kin::explain(problem, step);
}

}  // namespace thing_kin
