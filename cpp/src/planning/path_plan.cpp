#include "thing_kin/planning/path_plan.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "path_by_priority.hpp"
#include "path_check.hpp"
#include "path_solver.hpp"
#include "path_start.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/inverse/numeric_ik.hpp"
#include "thing_kin/kinematics/log_dexterity.hpp"
#include "thing_kin/kinematics/pose_error.hpp"

namespace thing_kin {

PathMethod path_method_from_string(const std::string& name) {
  if (name == "sqp") {
    return PathMethod::kSqp;
  }
  if (name == "task_priority") {
    return PathMethod::kTaskPriority;
  }
  throw InvalidArgument("method", quoted(name), "'sqp' or 'task_priority'");
}

const char* to_string(PathMethod method) {
  return method == PathMethod::kSqp ? "sqp" : "task_priority";
}

void PathOptions::check() const {
  const auto positive = [](const char* name, double value) {
    if (!(value > 0.0 && std::isfinite(value))) {
      throw InvalidArgument(name, text(value), "a number > 0");
    }
  };
  positive("position_tolerance", position_tolerance);
  positive("rotation_tolerance", rotation_tolerance);
  positive("constraint_tolerance", constraint_tolerance);
  if (max_iterations < 1) {
    throw InvalidArgument("max_iterations", std::to_string(max_iterations), "a whole number > 0");
  }
}

namespace {

bool is_at(const PathProblem& problem, const PathGoal& goal, const JointVector& q,
           const PathOptions& options) {
  const SE3 T = forward_kinematics(problem.chain(), q.data(), problem.frame());
  return (T.translation - goal.pose.translation).norm() <= options.position_tolerance &&
         rotation_angle(T.rotation, goal.pose.rotation) <= options.rotation_tolerance;
}

double log_dexterity_at(const PathProblem& problem, const JointVector& q) {
  Posture posture;
  Jacobian J;
  place_joints(problem.chain(), q.data(), posture);
  geometric_jacobian(problem.chain(), posture, problem.frame(), ReferenceFrame::kWorldAligned, J);
  return log_dexterity(J, problem.column_weights.data());
}

// One call of plan_path.
class Planner {
 public:
  Planner(const PathProblem& problem, const std::vector<PathGoal>& goals, const JointVector& seed,
          const std::vector<JointVector>& warm_start, const PathOptions& options)
      : problem_(problem), goals_(goals), seed_(seed), warm_start_(warm_start), options_(options) {}

  PathPlan run() {
    const auto start = std::chrono::steady_clock::now();
    if (place_first()) {
      if (options_.method == PathMethod::kTaskPriority) {
        follow_by_priority(problem_, goals_, first_, options_, plan_);
        judge(plan_);
      } else {
        optimize();
      }
    }
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    plan_.time = time.count();
    return std::move(plan_);
  }

 private:
  // q_0: the seed, or the solution of the first pose that is nearest to it.
  bool place_first() {
    held_ = is_at(problem_, goals_[0], seed_, options_);
    first_ = seed_;
    if (held_) {
      return true;
    }
    IkOptions nearest;
    nearest.nearest = true;
    nearest.max_restarts = 40;
    const IkResult result =
        NumericIk(problem_.chain(), problem_.frame(), nearest).solve(goals_[0].pose, seed_.data());
    first_ = result.q;
    if (result.success()) {
      return true;
    }
    plan_.q.assign(goals_.size(), first_);
    plan_.status = SolveStatus::kInfeasible;
    judge(plan_);
    plan_.message.append(" (").append(message(problem_.chain(), result)).append(")");
    return false;
  }

  // Lines for the base to follow, best first; an empty one leaves it where the hand takes it.
  std::vector<BaseLine> lines() {
    if (!problem_.chain().base_joints()) {
      return {BaseLine{}};
    }
    const BaseLine line = base_line();
    if (line.empty()) {
      return {line};
    }
    std::vector<BaseLine> past = lines_past_discs(problem_, line);
    if (past.size() == 1 && !problem_.has_base_path) {
      past[0].clear();
    }
    constexpr std::size_t kMostLines = 6;
    past.resize(std::min(past.size(), kMostLines));
    return past;
  }

  void optimize() {
    if (!warm_start_.empty() && attempt(warm_start_, -1)) {
      return;
    }
    for (const BaseLine& line : lines()) {
      if (attempt(line)) {
        return;
      }
    }
    if (problem_.chain().base_joints() && plan_.failed_constraint != "pose") {
      try_aside();
    }
  }

  // Begins on lines beside the base path, on all sides.
  void try_aside() {
    constexpr int kSides = 6;
    constexpr double kAside = 0.7;    // of base_radius
    constexpr double kUsually = 0.4;  // m, without one
    const double away =
        problem_.base_radius < kUnlimited ? kAside * problem_.base_radius : kUsually;
    const BaseLine path = base_line();
    for (int side = 0; side < kSides && !path.empty(); ++side) {
      const double angle = 2.0 * std::numbers::pi * side / kSides;
      BaseLine line = path;
      for (Eigen::Vector2d& place : line) {
        place += away * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      }
      if (attempt(lines_past_discs(problem_, line).front())) {
        return;
      }
    }
  }

  bool attempt(const BaseLine& line) {
    std::vector<JointVector> q;
    const int lost = follow_poses(problem_, goals_, first_, line, q);
    return attempt(q, lost);
  }

  // The base path, begun where the base stands; or where the hand takes the base; empty if that is
  // nowhere.
  BaseLine base_line() const {
    BaseLine line;
    const auto& base = *problem_.chain().base_joints();
    if (problem_.has_base_path) {
      const Eigen::Vector2d here(first_[base[0]], first_[base[1]]);
      const Eigen::Vector2d offset = here - goals_[0].base.head<2>();
      for (std::size_t k = 0; k < goals_.size(); ++k) {
        const double left = 1.0 - static_cast<double>(k) / static_cast<double>(goals_.size());
        line.emplace_back(goals_[k].base.head<2>() + left * offset);
      }
      return line;
    }
    std::vector<JointVector> q;
    if (follow_poses(problem_, goals_, first_, {}, q) < 0) {
      for (const JointVector& at : q) {
        line.emplace_back(at[base[0]], at[base[1]]);
      }
    }
    return line;
  }

  // Optimizes from q, of which waypoints from `lost` on (if not -1) are not on their poses; keeps
  // the result if it is the best so far. True if it is a success.
  bool attempt(const std::vector<JointVector>& q, int lost) {
    PathPlan plan;
    plan.q = q;
    if (lost < 0) {
      solve(plan);
    } else {
      plan.status = SolveStatus::kInfeasible;
    }
    judge(plan);
    plan.iterations += plan_.iterations;
    // What fails with all poses met says more than a start that lost the hand later on.
    const bool later = plan.failed_waypoint > plan_.failed_waypoint;
    if (plan_.q.empty() || plan.success || (lost < 0) > met_ || ((lost < 0) == met_ && later)) {
      met_ = lost < 0;
      plan_ = std::move(plan);
    } else {
      plan_.iterations = plan.iterations;
    }
    return plan_.success;
  }

  void solve(PathPlan& plan) {
    const int count = static_cast<int>(goals_.size());
    PathSolver solver(problem_, count);
    solver.set_goals(goals_);
    solver.hold_first(held_);
    solver.come_from(held_ ? nullptr : seed_.data());
    const double heaviest = problem_.joint_weights.cwiseAbs2().maxCoeff();
    solver.set_penalty(10.0 * (heaviest / count + problem_.dexterity_weight));
    for (int k = 0; k < count; ++k) {
      std::copy_n(plan.q[static_cast<std::size_t>(k)].data(), problem_.dof(), solver.q(k));
      if (k == 0 && held_) {
        std::copy_n(seed_.data(), problem_.dof(), solver.q(0));
      } else if (!solver.settle(k)) {
        plan.status = SolveStatus::kInfeasible;
        return;
      }
    }
    solver.begin();
    iterate(solver, plan);
  }

  void iterate(PathSolver& solver, PathPlan& plan) {
    constexpr int kRounds = 6;  // of points within segments that turned out to be needed
    int round = 0;
    plan.status = SolveStatus::kBudget;
    for (plan.iterations = 0; plan.iterations < options_.max_iterations; ++plan.iterations) {
      const PathSolver::Outcome outcome = solver.iterate();
      if (outcome == PathSolver::Outcome::kStepped) {
        continue;
      }
      plan.status = outcome == PathSolver::Outcome::kConverged ? SolveStatus::kConverged
                                                               : SolveStatus::kInfeasible;
      take(solver, plan);
      if (plan.status != SolveStatus::kConverged || ++round > kRounds || !watch(solver, plan)) {
        return;
      }
    }
    take(solver, plan);
  }

  void take(const PathSolver& solver, PathPlan& plan) const {
    for (int k = 0; k < solver.count(); ++k) {
      plan.q[static_cast<std::size_t>(k)] =
          Eigen::Map<const Eigen::VectorXd>(solver.q(k), problem_.dof());
    }
  }

  bool watch(PathSolver& solver, const PathPlan& plan) const {
    const std::vector<SegmentContact> contacts = find_contacts(problem_, plan.q, 0.0);
    bool inner = false;
    for (const SegmentContact& contact : contacts) {
      if (contact.t > 0.0 && contact.t < 1.0) {
        solver.watch(contact.segment, contact.clearance, contact.t);
        inner = true;
      }
    }
    if (inner) {
      solver.begin();
    }
    return inner;
  }

  // Errors, measures and verdict from q alone.
  void judge(PathPlan& plan) const {
    const std::size_t count = goals_.size();
    plan.position_error.resize(count);
    plan.rotation_error.resize(count);
    plan.dexterity.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const SE3 T = forward_kinematics(problem_.chain(), plan.q[k].data(), problem_.frame());
      plan.position_error[k] = (goals_[k].pose.translation - T.translation).norm();
      plan.rotation_error[k] = rotation_angle(T.rotation, goals_[k].pose.rotation);
      plan.dexterity[k] = std::exp(log_dexterity_at(problem_, plan.q[k]));
    }
    plan.objective = path_objective(problem_, plan.q, seed_);
    const std::vector<PathMiss> misses = check_path(
        problem_, goals_, plan.q, {options_.position_tolerance, options_.rotation_tolerance},
        options_.constraint_tolerance, plan.constraint_violation);
    plan.success = misses.empty();
    if (plan.success) {
      // The solver keeps a margin, and may fail at that alone.
      plan.status =
          plan.status == SolveStatus::kConverged ? SolveStatus::kConverged : SolveStatus::kBudget;
      plan.failed_waypoint = -1;
      plan.message = plan.status == SolveStatus::kConverged
                         ? "every waypoint is met"
                         : "every waypoint is met, but not at an optimum";
      return;
    }
    const PathMiss& first = misses.front();
    plan.failed_waypoint = first.waypoint;
    plan.failed_constraint = first.constraint;
    if (plan.status == SolveStatus::kConverged) {
      plan.status = SolveStatus::kInfeasible;
    }
    plan.message = std::string("waypoint ")
                       .append(std::to_string(first.waypoint))
                       .append(": ")
                       .append(first.constraint)
                       .append(" is missed by ")
                       .append(text(first.amount));
  }

  const PathProblem& problem_;
  const std::vector<PathGoal>& goals_;
  const JointVector& seed_;
  const std::vector<JointVector>& warm_start_;
  const PathOptions& options_;
  JointVector first_;
  bool held_ = false;
  bool met_ = false;  // all poses, by the plan's start
  PathPlan plan_;
};

}  // namespace

double path_objective(const PathProblem& problem, const std::vector<JointVector>& q,
                      const JointVector& seed) {
  const JointVector weights = problem.joint_weights.cwiseAbs2();
  double sum = 0.5 * weights.dot((q[0] - seed).cwiseAbs2());
  for (std::size_t k = 0; k < q.size(); ++k) {
    if (k > 0) {
      sum += 0.5 * weights.dot((q[k] - q[k - 1]).cwiseAbs2());
    }
    if (problem.dexterity_weight > 0.0) {
      sum += problem.dexterity_weight * log_dexterity_at(problem, q[k]);
    }
  }
  return sum;
}

PathPlan plan_path(const PathProblem& problem, const std::vector<PathGoal>& goals,
                   const JointVector& seed, const std::vector<JointVector>& warm_start,
                   const PathOptions& options) {
  options.check();
  if (goals.empty()) {
    throw InvalidArgument("poses", "none", "at least one");
  }
  if (seed.size() != problem.dof() || !seed.allFinite()) {
    throw InvalidArgument("seed", std::to_string(seed.size()).append(" numbers"),
                          "a finite one for each joint");
  }
  if (!warm_start.empty() && warm_start.size() != goals.size()) {
    throw InvalidArgument("warm_start", std::to_string(warm_start.size()).append(" waypoints"),
                          "as many as poses");
  }
  return Planner(problem, goals, seed, warm_start, options).run();
}

}  // namespace thing_kin
