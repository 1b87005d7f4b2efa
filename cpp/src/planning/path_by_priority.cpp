#include "path_by_priority.hpp"

#include <algorithm>
#include <array>

#include "thing_kin/inverse/task_priority.hpp"
#include "thing_kin/kinematics/pose_error.hpp"

namespace thing_kin {

namespace {

using RowMajorPose = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

constexpr double kWaypointOnPose = 1e-9;  // m and rad
constexpr double kRest = 1e-6;            // a step of the joints that is none, m and rad

class PriorityFollower {
 public:
  explicit PriorityFollower(const PathProblem& problem)
      : problem_(problem), solver_(make(problem)), dq_(JointVector::Zero(problem.dof())) {}

  // How many steps it took; at most `most`.
  int settle(const PathGoal& goal, int most, JointVector& q, bool& there) {
    const RowMajorPose pose = goal.pose.matrix();
    int steps = 0;
    there = false;
    for (;; ++steps) {
      const double away = distance(goal, q);
      there = away < kWaypointOnPose;
      if (there && (steps > 0 && dq_.lpNorm<Eigen::Infinity>() < kRest)) {
        return steps;
      }
      if (steps == most) {
        return steps;
      }
      const Eigen::Vector3d base = base_target(goal, q);
      const std::array<const double*, 2> targets{pose.data(), base.data()};
      solver_.step_limited(q.data(), std::span(targets).first(solver_.tasks().size()), nullptr,
                           nullptr, dq_);
      q += dq_;
    }
  }

 private:
  static TaskPriority make(const PathProblem& problem) {
    std::vector<std::shared_ptr<const Task>> tasks;
    const auto frame = static_cast<std::size_t>(problem.frame());
    tasks.push_back(std::make_shared<PoseTask>(1.0, problem.chain().frames()[frame].name));
    if (problem.has_base_path) {
      tasks.push_back(std::make_shared<BaseTask>());
    }
    TaskPriorityOptions options = TaskPriorityOptions::limited(LimitOptions(1.0));
    options.step_limit = JointVector::Constant(problem.dof(), 0.5);
    return {problem.chain(), std::move(tasks), std::move(options)};
  }

  double distance(const PathGoal& goal, const JointVector& q) const {
    const SE3 T = forward_kinematics(problem_.chain(), q.data(), problem_.frame());
    const Vector6 e = pose_error(T, goal.pose);
    return std::max(e.head<3>().norm(), e.tail<3>().norm());
  }

  Eigen::Vector3d base_target(const PathGoal& goal, const JointVector& q) const {
    Eigen::Vector3d target = goal.base;
    if (problem_.has_base_path && !problem_.has_base_heading) {
      target[2] = q[(*problem_.chain().base_joints())[2]];
    }
    return target;
  }

  const PathProblem& problem_;
  TaskPriority solver_;
  JointVector dq_;
};

}  // namespace

void follow_by_priority(const PathProblem& problem, const std::vector<PathGoal>& goals,
                        const JointVector& first, const PathOptions& options, PathPlan& plan) {
  PriorityFollower follower(problem);
  plan.q.assign(goals.size(), first);
  JointVector at = first;
  plan.status = SolveStatus::kConverged;
  for (std::size_t k = 1; k < goals.size(); ++k) {
    JointVector next = at;
    bool there = false;
    plan.iterations += follower.settle(goals[k], options.max_iterations, next, there);
    if (!there) {
      plan.status = SolveStatus::kInfeasible;
      std::fill(plan.q.begin() + static_cast<std::ptrdiff_t>(k), plan.q.end(), at);
      return;
    }
    at = next;
    plan.q[k] = at;
  }
}

}  // namespace thing_kin
