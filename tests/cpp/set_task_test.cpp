// Set-based tasks: exact Jacobians, and what they do at their tips and poles.

#include "thing_kin/inverse/set_task.hpp"

#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/model/robots.hpp"

namespace thing_kin {
namespace {

IntervalValue at(const SetTask& task, const Chain& robot, const Eigen::VectorXd& q,
                 const Eigen::VectorXd& target) {
  Posture posture;
  place_joints(robot, q.data(), posture);
  IntervalValue interval;
  task.evaluate_interval(robot, posture, robot.tool(), q.data(), target.data(), interval);
  return interval;
}

std::vector<std::unique_ptr<SetTask>> all_tasks() {
  std::vector<std::unique_ptr<SetTask>> tasks;
  tasks.push_back(std::make_unique<DistanceTask>(0.1, 2.0));
  tasks.push_back(std::make_unique<BaseObstacleTask>(0.5));
  tasks.push_back(std::make_unique<FieldOfViewTask>(0.4));
  tasks.push_back(std::make_unique<FieldOfViewTask>(0.4, Eigen::Vector3d(1, -2, 0.5)));
  tasks.push_back(std::make_unique<JointRangeTask>(JointVector::Constant(9, -1.0),
                                                   JointVector::Constant(9, kInfinity)));
  return tasks;
}

TEST(SetTask, JacobianIsTheDerivative) {
  const Chain robot = robots::thing();
  test::Generator rng(1);
  for (const auto& task : all_tasks()) {
    for (int i = 0; i < 200; ++i) {
      const Eigen::VectorXd q = test::random_vector(rng, 9);
      const Eigen::VectorXd target = test::random_vector(rng, 3, 2.0);
      const IntervalValue here = at(*task, robot, q, target);
      ASSERT_EQ(here.jacobian.rows(), task->rows(robot));
      constexpr double h = 1e-6;
      for (int j = 0; j < 9; ++j) {
        const Eigen::VectorXd d = h * Eigen::VectorXd::Unit(9, j);
        const Eigen::VectorXd slope =
            (at(*task, robot, q + d, target).value - at(*task, robot, q - d, target).value) /
            (2 * h);
        EXPECT_LT((slope - here.jacobian.col(j)).norm(), 1e-6) << task->kind() << " joint " << j;
      }
    }
  }
}

TEST(SetTask, EdgesAreFinite) {
  const Chain robot = robots::thing();
  test::Generator rng(2);
  const Eigen::VectorXd q = test::random_vector(rng, 9);
  const SE3 T = forward_kinematics(robot, q.data(), robot.tool());
  const Eigen::Vector3d z = T.rotation.col(2);
  for (const double distance : {0.0, 1e-300, 1e-12, 1.0, -1.0, -1e-12}) {
    const Eigen::VectorXd target = T.translation + distance * z;
    for (const auto& task : all_tasks()) {
      const IntervalValue interval = at(*task, robot, q, target);
      EXPECT_TRUE(interval.jacobian.allFinite() && interval.value.allFinite()) << task->kind();
    }
  }
  const IntervalValue ahead = at(FieldOfViewTask(0.4), robot, q, T.translation + 2.0 * z);
  EXPECT_LT(ahead.value[0], 1e-7);
  const IntervalValue behind = at(FieldOfViewTask(0.4), robot, q, T.translation - 2.0 * z);
  EXPECT_NEAR(behind.value[0], std::numbers::pi, 1e-7);
  EXPECT_GT(behind.jacobian.norm(), 0.1);  // there is a way out
  const IntervalValue same = at(DistanceTask(0.1, 1.0), robot, q, T.translation);
  EXPECT_EQ(same.value[0], 0.0);
  EXPECT_GT(same.jacobian.norm(), 0.1);
}

TEST(SetTask, TheErrorLeadsBackInside) {
  const Chain robot = robots::thing();
  Eigen::VectorXd q = Eigen::VectorXd::Zero(9);
  Posture posture;
  place_joints(robot, q.data(), posture);
  const Eigen::Vector2d center(0.2, 0.0);
  TaskValue value;
  BaseObstacleTask(0.5).evaluate(robot, posture, robot.tool(), q.data(), center.data(), value);
  EXPECT_NEAR(value.error[0], 0.3, 1e-15);
  BaseObstacleTask(0.1).evaluate(robot, posture, robot.tool(), q.data(), center.data(), value);
  EXPECT_EQ(value.error[0], 0.0);
}

}  // namespace
}  // namespace thing_kin
