#include "thing_kin/inverse/task_priority.hpp"

#include <thread>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/kinematics/pose_error.hpp"
#include "thing_kin/model/robots.hpp"

namespace thing_kin {
namespace {

struct Problem {
  Chain robot = robots::thing();
  Eigen::VectorXd q;
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> T_goal;
  Eigen::Vector3d base_goal;

  explicit Problem(test::Generator& rng)
      : q(test::random_vector(rng, 9)), base_goal(test::random_vector(rng, 3, 1.0)) {
    const Eigen::VectorXd goal = q + test::random_vector(rng, 9, 0.3);
    T_goal = forward_kinematics(robot, goal.data(), robot.tool()).matrix();
  }

  JointVector step(const TaskPriorityOptions& options, bool with_base = true) const {
    std::vector<std::shared_ptr<const Task>> tasks = {std::make_shared<PoseTask>()};
    if (with_base) {
      tasks.push_back(std::make_shared<BaseTask>(0.5));
    }
    const std::array<const double*, 2> targets = {T_goal.data(), base_goal.data()};
    auto result = std::make_unique<TaskPriorityStep>();
    TaskPriority(robot, tasks, options)
        .solve(q.data(), std::span(targets).first(tasks.size()), nullptr, *result);
    return result->dq;
  }

  Jacobian jacobian() const {
    Posture posture;
    Jacobian J;
    place_joints(robot, q.data(), posture);
    geometric_jacobian(robot, posture, robot.tool(), ReferenceFrame::kWorldAligned, J);
    return J;
  }
};

TEST(TaskPriority, LowerTasksLeaveHigherOnesAlone) {
  test::Generator rng(1);
  for (int i = 0; i < 100; ++i) {
    Problem problem(rng);
    if (i % 2 == 0) {
      problem.q[4] = i % 4 == 0 ? 0.0 : 1e-7;  // the wrist's singularity
    }
    const Eigen::MatrixXd A = problem.jacobian();
    for (const Scheme scheme : {Scheme::kNakamura, Scheme::kSiciliano, Scheme::kChiaverini}) {
      for (const DifferentialInverse& inverse :
           {DifferentialInverse(Exact()), DifferentialInverse(Damped(1e-3)),
            DifferentialInverse(SelectivelyDamped())}) {
        const TaskPriorityOptions options{scheme, inverse, SingularValueFilter(0.01, 10.0), {}};
        const Eigen::VectorXd both = problem.step(options);
        const Eigen::VectorXd alone = problem.step(options, false);
        EXPECT_LT((A * (both - alone)).norm(), 1e-10 * std::max(1.0, both.norm()));
      }
    }
  }
}

TEST(TaskPriority, ExactStepSolvesTheLinearProblem) {
  test::Generator rng(2);
  for (int i = 0; i < 100; ++i) {
    const Problem problem(rng);
    const Eigen::MatrixXd A = problem.jacobian();
    const SE3 T = forward_kinematics(problem.robot, problem.q.data(), problem.robot.tool());
    const SE3 goal{problem.T_goal.topLeftCorner<3, 3>(), problem.T_goal.topRightCorner<3, 1>()};
    const Vector6 a = pose_error(T, goal);
    const Eigen::VectorXd dq = problem.step({Scheme::kSiciliano, Exact(), {}, {}});
    EXPECT_LT((A * dq - a).norm(), 1e-8 * std::max(1.0, dq.norm()));
    // Nine joints, nine rows: where both tasks can be met, both are.
    Eigen::Vector3d b = problem.base_goal - problem.q.tail(3);
    b[2] = std::remainder(b[2], 2 * std::numbers::pi);
    Eigen::Matrix<double, 9, 9> stacked;
    stacked << A, Eigen::Matrix<double, 3, 6>::Zero(), Eigen::Matrix3d::Identity();
    Eigen::Matrix<double, 9, 1> rhs;
    rhs << a, 0.5 * b;
    const Eigen::VectorXd solution = stacked.fullPivLu().solve(rhs);
    EXPECT_LT((dq - solution).norm(), 1e-6 * std::max(1.0, solution.norm()));
  }
}

TEST(TaskPriority, StepLimitKeepsDirections) {
  test::Generator rng(3);
  for (int i = 0; i < 200; ++i) {
    const Problem problem(rng);
    TaskPriorityOptions options{Scheme::kChiaverini, Exact(), {}, {}};
    const Eigen::VectorXd alone = problem.step(options, false);
    options.step_limit = JointVector::Constant(9, 0.05);
    const Eigen::VectorXd limited = problem.step(options);
    EXPECT_LE(limited.cwiseAbs().maxCoeff(), 0.05 * (1 + 1e-12));
    const Eigen::MatrixXd A = problem.jacobian();
    const Eigen::VectorXd wanted = A * alone;
    const Eigen::VectorXd got = A * limited;
    const double scale = got.dot(wanted) / wanted.squaredNorm();
    EXPECT_GE(scale, 0.0);
    EXPECT_LE(scale, 1.0 + 1e-9);
    EXPECT_LT((got - scale * wanted).norm(), 1e-9 * std::max(1.0, alone.norm()));
  }
}

TEST(TaskPriority, OneSolverServesFourThreads) {
  test::Generator rng(4);
  const Problem problem(rng);
  const TaskPriorityOptions options{
      Scheme::kSiciliano, SelectivelyDamped(), SingularValueFilter(0.01, 10.0), {}};
  const TaskPriority solver(problem.robot,
                            {std::make_shared<PoseTask>(), std::make_shared<BaseTask>()}, options);
  const std::array<const double*, 2> targets = {problem.T_goal.data(), problem.base_goal.data()};
  std::array<JointVector, 4> results;
  std::vector<std::thread> threads;
  for (JointVector& result : results) {
    threads.emplace_back([&] {
      auto step = std::make_unique<TaskPriorityStep>();
      Eigen::VectorXd q = problem.q;
      for (int i = 0; i < 200; ++i) {
        solver.solve(q.data(), targets, nullptr, *step);
        q += step->dq;
      }
      result = q;
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (const JointVector& result : results) {
    EXPECT_EQ(result, results[0]);
  }
}

}  // namespace
}  // namespace thing_kin
