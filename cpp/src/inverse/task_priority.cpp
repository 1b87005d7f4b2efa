#include "thing_kin/inverse/task_priority.hpp"

#include <algorithm>
#include <cmath>

#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/minimum_norm.hpp"

namespace thing_kin {

namespace {

constexpr std::array kSchemes = {Scheme::kNakamura, Scheme::kSiciliano, Scheme::kChiaverini};

// One level: J dq = wanted, after levels that leave the columns of Z free.
struct LevelProblem {
  const SmallMatrix& J;
  const SmallMatrix& Z;
  const SmallVector& wanted;
  bool robust;           // (4.17): invert J, then project; else invert J Z
  bool need_null_space;  // of this level and all above

  bool first() const { return Z.cols() == J.cols(); }
};

// The same with right singular vectors and null space in joint space: J Z = U S V^T (Z^T Z = I).
void decompose_in(const SmallMatrix& J, const SmallMatrix& Z, Svd& svd) {
  const SmallMatrix reduced = J * Z;
  decompose(reduced, svd, J.norm());
  const SmallMatrix lifted = Z * svd.v;
  svd.v = lifted;
}

// The decomposition of the matrix that the level inverts.
void decompose_level(const LevelProblem& level, Svd& svd) {
  if (level.robust || level.first()) {
    decompose(level.J, svd);
  } else {
    decompose_in(level.J, level.Z, svd);
  }
}

// By QR, for the exact inverse of what is clearly regular; false if it is not.
bool solve_regular(const LevelProblem& level, JointVector& dq, SmallMatrix& next_Z) {
  const bool whole = level.robust || level.first();
  const SmallMatrix reduced = level.first() ? SmallMatrix() : SmallMatrix(level.J * level.Z);
  MinimumNorm inverse;
  const double scale = level.J.norm();
  if (!inverse.factor(whole ? level.J : reduced, scale)) {
    return false;
  }
  dq = inverse.solve(level.wanted);
  if (!whole) {
    const JointVector lifted = level.Z * dq;
    dq = lifted;
  }
  if (level.need_null_space) {
    if (whole && !level.first() && !inverse.factor(reduced, scale)) {
      return false;
    }
    next_Z = inverse.null_space();
    if (!level.first()) {
      const SmallMatrix lifted = level.Z * next_Z;
      next_Z = lifted;
    }
  }
  return true;
}

// Basis of what this level and all above leave free.
SmallMatrix null_space_below(const LevelProblem& level, const Svd& svd) {
  if (level.robust && !level.first()) {
    Svd below;
    decompose_in(level.J, level.Z, below);
    return below.v.rightCols(below.v.cols() - below.rank);
  }
  return svd.v.rightCols(svd.v.cols() - svd.rank);
}

}  // namespace

const char* to_string(Scheme scheme) {
  switch (scheme) {
    case Scheme::kNakamura:
      return "nakamura";
    case Scheme::kSiciliano:
      return "siciliano";
    case Scheme::kChiaverini:
      break;
  }
  return "chiaverini";
}

Scheme scheme_from_string(const std::string& name) {
  for (const Scheme scheme : kSchemes) {
    if (name == to_string(scheme)) {
      return scheme;
    }
  }
  throw InvalidArgument("scheme", quoted(name), "'nakamura', 'siciliano' or 'chiaverini'");
}

TaskPriority::TaskPriority(Chain chain, std::vector<std::shared_ptr<const Task>> tasks,
                           TaskPriorityOptions options)
    : chain_(std::move(chain)), tasks_(std::move(tasks)), options_(std::move(options)) {
  const std::size_t most =
      options_.scheme == Scheme::kNakamura ? 2 : static_cast<std::size_t>(kMaxTasks);
  if (tasks_.empty() || tasks_.size() > most) {
    throw InvalidArgument(
        "tasks", std::to_string(tasks_.size()) + " tasks",
        "1 to " + std::to_string(most) + " with scheme '" + to_string(options_.scheme) + "'");
  }
  for (const auto& task : tasks_) {
    if (task->needs_base() && !chain_.base_joints()) {
      throw InvalidArgument("tasks", std::string(task->kind()) + " for " + quoted(chain_.name()),
                            "a robot on an omnidirectional base (on_omni_base)");
    }
    if (task->joints() != 0 && task->joints() != chain_.dof()) {
      throw InvalidArgument("tasks",
                            std::string(task->kind()) + " of " + std::to_string(task->joints()),
                            std::to_string(chain_.dof()) + " joints");
    }
    sets_.push_back(dynamic_cast<const SetTask*>(task.get()));
    frames_.push_back(task->frame().empty() ? chain_.tool()
                                            : chain_.frame_index(task->frame(), "of"));
  }
  if (options_.step_limit) {
    const JointVector& limit = *options_.step_limit;
    if (limit.size() != chain_.dof() || !(limit.array() > 0.0).all()) {
      throw InvalidArgument("step_limit", "an array of " + std::to_string(limit.size()),
                            std::to_string(chain_.dof()) + " positive numbers (inf: no limit)");
    }
  }
  check_limits();
}

// Z: orthonormal basis of the null space of all levels above. next_Z: with this level too.
void TaskPriority::add_level(int index, const TaskValue& value, const SmallMatrix& Z,
                             bool need_null_space, TaskPriorityStep& step,
                             SmallMatrix& next_Z) const noexcept {
  const Task& task = *tasks_[static_cast<std::size_t>(index)];
  TaskPriorityStep::Level& result = step.levels[static_cast<std::size_t>(index)];
  const bool robust = options_.scheme == Scheme::kChiaverini;
  const bool regularized = options_.filter || !std::holds_alternative<Exact>(options_.inverse);

  // (4.16): dq_i = N (J N)# (e - J dq_{i-1}); (4.17): N J# e, N the exact projector Z Z^T.
  SmallVector wanted = task.gain() * value.error;
  if (!robust) {
    wanted -= value.jacobian * step.dq;
  }
  const LevelProblem level{value.jacobian, Z, wanted, robust, need_null_space};
  result.error = value.error;
  if (regularized || !solve_regular(level, result.contribution, next_Z)) {
    Svd svd;
    decompose_level(level, svd);
    if (need_null_space) {
      next_Z = null_space_below(level, svd);
    }
    if (options_.filter) {
      options_.filter->apply(svd);
    }
    result.contribution = apply_inverse(options_.inverse, svd, task.blocks(chain_), wanted);
  }
  if (robust && !level.first()) {
    const SmallVector free = Z.transpose() * result.contribution;
    result.contribution.noalias() = Z * free;
  }
  step.dq += result.contribution;
}

void TaskPriority::singular_values(const double* q, std::span<const double* const> targets,
                                   std::span<SmallVector> sigma) const noexcept {
  const int n = chain_.dof();
  Posture posture;
  place_joints(chain_, q, posture);
  SmallMatrix Z = SmallMatrix::Identity(n, n);
  TaskValue value;
  Svd svd;
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    tasks_[i]->evaluate(chain_, posture, frames_[i], q, targets[i], value);
    const LevelProblem level{value.jacobian, Z, value.error, options_.scheme == Scheme::kChiaverini,
                             true};
    decompose_level(level, svd);
    sigma[i] = svd.sigma;
    const SmallMatrix next_Z = null_space_below(level, svd);
    Z = next_Z;
  }
}

void TaskPriority::solve(const double* q, std::span<const double* const> targets,
                         const double* null_motion, TaskPriorityStep& step) const noexcept {
  const int n = chain_.dof();
  const int tasks = static_cast<int>(tasks_.size());
  step.count = tasks + (null_motion != nullptr ? 1 : 0);
  step.dq.setZero(n);

  Posture posture;
  place_joints(chain_, q, posture);
  SmallMatrix Z = SmallMatrix::Identity(n, n);
  SmallMatrix next_Z;
  TaskValue value;
  for (int level = 0; level < tasks; ++level) {
    const auto i = static_cast<std::size_t>(level);
    tasks_[i]->evaluate(chain_, posture, frames_[i], q, targets[i], value);
    const bool more = level + 1 < step.count;
    add_level(level, value, Z, more, step, next_Z);
    if (more) {
      Z = next_Z;
    }
  }
  if (null_motion != nullptr) {
    const Eigen::Map<const Eigen::VectorXd> z(null_motion, n);
    TaskPriorityStep::Level& free = step.levels[static_cast<std::size_t>(tasks)];
    const SmallVector along = Z.transpose() * z;
    free.contribution = Z * along;
    free.error.resize(0);
    step.dq += free.contribution;
  }
  for (int level = 0; level < step.count; ++level) {
    step.levels[static_cast<std::size_t>(level)].scale = 1.0;
  }
  if (options_.step_limit) {
    scale_to_limit(*options_.step_limit, step);
  }
}

}  // namespace thing_kin
