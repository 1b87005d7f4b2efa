#include "thing_kin/planning/path_plan.hpp"

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/pose_error.hpp"
#include "thing_kin/model/robots.hpp"
#include "thing_kin/planning/path_follower.hpp"

namespace thing_kin {
namespace {

JointVector seed_of_thing() {
  JointVector q(9);
  q << 0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0;
  return q;
}

// Straight ahead past a disc.
std::vector<PathGoal> goals_ahead(const Chain& robot, int count) {
  const SE3 start = forward_kinematics(robot, seed_of_thing().data(), robot.tool());
  std::vector<PathGoal> goals(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    PathGoal& goal = goals[static_cast<std::size_t>(k)];
    const double s = static_cast<double>(k) / (count - 1);
    goal.pose = start;
    goal.pose.translation[0] += 3.0 * s;
    goal.base << 3.0 * s, 0.2 * std::sin(3.14 * s), 0.0;
  }
  return goals;
}

PathProblem problem_of(const Chain& robot, int count) {
  Disc disc;
  disc.center = {1.5, 0.45};
  disc.radius = 0.5;
  PathProblem problem(robot, robot.tool(), {disc}, {});
  problem.has_base_path = true;
  problem.has_base_heading = true;
  problem.base_radius = 0.3;
  problem.max_joint_step.setConstant(20.0 / count);
  problem.dexterity_weight = 1.0 / (count * count);
  return problem;
}

TEST(PathPlan, ConvergesQuadratically) {
  const Chain robot = robots::thing();
  const PathProblem problem = problem_of(robot, 50);
  const auto plan = plan_path(problem, goals_ahead(robot, 50), seed_of_thing(), {}, {});
  ASSERT_TRUE(plan.success) << plan.message;
  EXPECT_LE(plan.iterations, 12);  // a method with wrong curvature takes dozens
  EXPECT_EQ(plan.constraint_violation, 0.0);
}

TEST(PathProblem, ItsBoundsHold) {
  const Chain robot = robots::thing();
  test::Generator rng(1);
  LinkSpheres shape = spheres_along_links(robot, 0.08, 0.2);
  shape.pairs = self_collision_pairs(robot, shape.spheres);
  Sphere ball;
  ball.center = {1.0, 0.5, 0.8};
  ball.radius = 0.2;
  const PathProblem problem(robot, robot.tool(), {ball, Disc{{0.5, 0.5}, 0.3}}, shape);
  const Clearances& clearances = problem.clearances();
  constexpr double kStep = 1e-3;
  for (int trial = 0; trial < 50; ++trial) {
    const JointVector q = test::random_vector(rng, 9);
    const JointVector dq = test::random_vector(rng, 9, 0.3);
    const auto value = [&](int i, double t) {
      const JointVector at = q + t * dq;
      Posture posture;
      place_joints(robot, at.data(), posture);
      return clearances.value(posture, at.data(), i);
    };
    for (int i = 0; i < clearances.size(); ++i) {
      const double way = problem.motion_bound(i, q.data(), dq.data());
      const double bend = problem.curvature_bound(i, q.data(), dq.data());
      for (const double t : {0.2, 0.5, 0.8}) {
        EXPECT_LE(std::abs(value(i, t) - value(i, 0.0)), t * way + 1e-12);
        const double second =
            (value(i, t + kStep) - 2.0 * value(i, t) + value(i, t - kStep)) / (kStep * kStep);
        EXPECT_GE(second, -bend - 1e-6) << clearances.describe(i);
      }
    }
  }
}

TEST(PathFollower, GoesPastTheDiscOnItsPoses) {
  const Chain robot = robots::thing();
  const std::vector<PathGoal> goals = goals_ahead(robot, 200);
  PathFollower follower(problem_of(robot, 200), 30, seed_of_thing());
  std::size_t next = 0;
  JointVector last = seed_of_thing();
  std::size_t done = 0;
  for (FollowerStep step; next < goals.size() || follower.pending() > 0; ++done) {
    while (next < goals.size() && follower.push(goals[next])) {
      ++next;
    }
    ASSERT_TRUE(follower.step(step));
    EXPECT_LT(step.position_error, 1e-9);
    EXPECT_LT(step.rotation_error, 1e-9);
    EXPECT_LT(step.violation, 1e-5) << done;
    const SE3 T = forward_kinematics(robot, step.q.data(), robot.tool());
    EXPECT_LT(pose_error(T, goals[done].pose).norm(), 1e-9);
    EXPECT_GE((step.q.segment<2>(6) - Eigen::Vector2d(1.5, 0.45)).norm(), 0.5 - 1e-5);
    EXPECT_LE((step.q - last).lpNorm<Eigen::Infinity>(), 0.1 + 1e-5);
    last = step.q;
  }
  EXPECT_EQ(done, goals.size());
}

TEST(PathFollower, RefusesWhatItCannotReach) {
  const Chain robot = robots::thing();
  PathFollower follower(problem_of(robot, 50), 3, seed_of_thing());
  PathGoal goal = goals_ahead(robot, 50)[0];
  PathGoal far = goal;
  far.pose.translation[2] += 10.0;
  EXPECT_FALSE(follower.push(far));
  EXPECT_EQ(follower.pending(), 0);
  FollowerStep step;
  EXPECT_FALSE(follower.step(step));
  EXPECT_TRUE(follower.push(goal));
  EXPECT_TRUE(follower.push(goal));
  EXPECT_TRUE(follower.push(goal));
  EXPECT_FALSE(follower.push(goal));
  EXPECT_TRUE(follower.step(step));
  EXPECT_EQ(follower.pending(), 2);
}

TEST(PathFollower, TakesNoNonsense) {
  const Chain robot = robots::thing();
  EXPECT_THROW(PathFollower(problem_of(robot, 50), 0, seed_of_thing()), InvalidArgument);
  EXPECT_THROW(PathFollower(problem_of(robot, 50), 3, JointVector::Zero(4)), InvalidArgument);
}

}  // namespace
}  // namespace thing_kin
