#include <memory>

#include "problem.hpp"
#include "thing_kin/inverse/task_priority.hpp"
#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/kinematics/posture.hpp"
#include "thing_kin/linalg/pseudoinverse.hpp"

namespace {

using bench::Problem;
using namespace thing_kin;

SmallMatrix inverse(const Problem::Input& input) { return exact_pseudoinverse(input.jacobian); }

JointVector velocity(const Problem::Input& input) {
  const Chain& robot = bench::problem().robot;
  Posture posture;
  Jacobian J;
  place_joints(robot, input.q.data(), posture);
  geometric_jacobian(robot, posture, robot.tool(), ReferenceFrame::kWorldAligned, J);
  return minimum_norm_solution(J, input.twist);
}

// A solver with the pose first and the base second, and its step.
struct Step {
  explicit Step(TaskPriorityOptions options)
      : solver(std::make_shared<TaskPriority>(
            bench::problem().robot,
            std::vector<std::shared_ptr<const Task>>{std::make_shared<PoseTask>(),
                                                     std::make_shared<BaseTask>()},
            std::move(options))),
        step(std::make_shared<TaskPriorityStep>()) {}

  const JointVector& operator()(const Problem::Input& input) {
    std::array<double, 16> T{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> goal(T.data());
    goal.topLeftCorner<3, 3>() = input.T_goal.rotation;
    goal.topRightCorner<3, 1>() = input.T_goal.translation;
    const std::array<const double*, 2> targets{T.data(), input.base_goal.data()};
    solver->solve(input.q.data(), targets, nullptr, *step);
    return step->dq;
  }

  std::shared_ptr<TaskPriority> solver;
  std::shared_ptr<TaskPriorityStep> step;
};

// Hand, base and posture within the robot's limits; goals two centimeters away and 20 ms: some
// steps meet a bound, some don't.
struct BoundedStep {
  JointVector operator()(const Problem::Input& input) {
    std::array<double, 16> T{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> goal(T.data());
    goal.topLeftCorner<3, 3>() = input.T_goal.rotation;
    goal.topRightCorner<3, 1>() = input.T_goal.translation;
    const std::array<const double*, 3> targets{T.data(), input.base_goal.data(), input.q.data()};
    JointVector dq;
    solver->step_limited(input.q.data(), targets, nullptr, nullptr, dq);
    return dq;
  }

  std::shared_ptr<TaskPriority> solver =
      std::make_shared<TaskPriority>(bench::problem().robot,
                                     std::vector<std::shared_ptr<const Task>>{
                                         std::make_shared<PoseTask>(), std::make_shared<BaseTask>(),
                                         std::make_shared<PostureTask>()},
                                     TaskPriorityOptions::limited(LimitOptions(0.02)));
};

[[maybe_unused]] const bool entered = [] {
  bench::enter("pinv_6x9", "thing_kin", inverse, bench::as_it_is);
  bench::enter("velocity", "thing_kin", velocity, bench::as_it_is);
  bench::enter("step", "thing_kin", Step({Scheme::kChiaverini, Exact(), {}, {}}), bench::as_it_is);
  bench::enter("step_limited", "thing_kin", BoundedStep(), bench::as_it_is);
  const SingularValueFilter filter(0.01, 10.0);
  bench::enter("step_regularized", "thing_kin",
               Step({Scheme::kChiaverini, SelectivelyDamped(), filter, {}}), bench::as_it_is);
  return true;
}();

}  // namespace
