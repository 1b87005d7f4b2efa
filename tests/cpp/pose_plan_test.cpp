#include "thing_kin/optimization/pose_plan.hpp"

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/kinematics/pose_error.hpp"
#include "thing_kin/model/robots.hpp"

namespace thing_kin {
namespace {

using test::Generator;
using test::random_vector;
using test::uniform;

struct Instance {
  SE3 target;
  JointVector drawn, seed;
  PosePlanOptions options;
  std::vector<Obstacle> obstacles;
};

// A pose of a random configuration, which is feasible: within disc, window and limits, out of a
// disc that is near.
Instance random_instance(const Chain& robot, Generator& rng) {
  Instance instance;
  JointVector& q = instance.drawn;
  q = random_vector(rng, 9);
  instance.target = forward_kinematics(robot, q.data(), robot.tool());
  const double radius = uniform(rng, 0.2, 0.6);
  const Eigen::Rotation2Dd turn(uniform(rng, -3, 3));
  const Eigen::Vector2d base(q[6], q[7]);
  instance.options.base_goal = base + turn * Eigen::Vector2d(uniform(rng, 0, radius), 0);
  instance.options.base_radius = radius;
  const double width = uniform(rng, 0.2, 1.2);
  const double middle = q[8] + uniform(rng, -width, width);
  instance.options.heading = {middle - width, middle + width};
  const double keep_out = uniform(rng, 0.1, 0.5);
  const Eigen::Rotation2Dd aside(uniform(rng, -3, 3));
  const Eigen::Vector2d center =
      base + aside * Eigen::Vector2d(keep_out + uniform(rng, 0.01, 0.5), 0);
  instance.obstacles = {Disc{center, keep_out}};
  instance.seed = random_vector(rng, 9);
  return instance;
}

// Nothing of the planner's own.
void expect_feasible(const Chain& robot, const Instance& instance, const JointVector& q) {
  const SE3 hand = forward_kinematics(robot, q.data(), robot.tool());
  EXPECT_LE(pose_error(hand, instance.target).norm(), 1e-8);
  const Eigen::Vector2d base(q[6], q[7]);
  EXPECT_LE((base - *instance.options.base_goal).norm(), instance.options.base_radius + 1e-8);
  const auto& disc = std::get<Disc>(instance.obstacles[0]);
  EXPECT_GE((base - disc.center).norm(), disc.radius - 1e-8);
  EXPECT_GE(q[8], (*instance.options.heading)[0]);
  EXPECT_LE(q[8], (*instance.options.heading)[1]);
  for (Eigen::Index j = 0; j < 9; ++j) {
    EXPECT_GE(q[j], robot.lower()[j]);
    EXPECT_LE(q[j], robot.upper()[j]);
  }
}

TEST(PosePlan, RandomInstancesFromFarSeedsAreSolved) {
  const Chain robot = robots::thing();
  Generator rng(20);
  for (int i = 0; i < 300; ++i) {
    const Instance instance = random_instance(robot, rng);
    const PosePlanner planner(robot, robot.tool(), instance.options, {}, instance.obstacles);
    const PosePlan plan = planner.solve(instance.target, instance.seed.data());
    ASSERT_TRUE(plan.success()) << i << ": " << message(planner, plan);
    expect_feasible(robot, instance, plan.q);
    EXPECT_LE(plan.constraint_violation, 1e-8);
  }
}

// No feasible move of the base, the arm's branch kept, makes the objective less.
TEST(PosePlan, NoNeighborIsBetter) {
  const Chain robot = robots::thing();
  Generator rng(21);
  int neighbors = 0;
  for (int i = 0; i < 60; ++i) {
    const Instance instance = random_instance(robot, rng);
    const PosePlanner planner(robot, robot.tool(), instance.options, {}, instance.obstacles);
    const PosePlan plan = planner.solve(instance.target, instance.seed.data());
    const auto closed = ClosedFormIk::find(robot, robot.tool());
    for (int k = 0; k < 40; ++k) {
      double base[3];
      for (Eigen::Index j = 0; j < 3; ++j) {
        base[j] = plan.q[6 + j] + uniform(rng, -1e-3, 1e-3);
      }
      ClosedFormSolutions solutions;
      closed->solve(instance.target, base, solutions, {.seed = plan.q.data(), .closest = false});
      if (solutions.count == 0 || !solutions.begin()->exact ||
          (solutions.begin()->q - plan.q).norm() > 0.1) {
        continue;
      }
      const JointVector& q = solutions.begin()->q;
      bool feasible = true;
      for (int c = 0; c < planner.constraints(); ++c) {
        feasible &= planner.violation(c, q, 0.0, 0.0) <= 0.0;
      }
      if (feasible) {
        ++neighbors;
        EXPECT_GE(planner.objective(q), plan.objective * (1 - 1e-7));
      }
    }
  }
  EXPECT_GT(neighbors, 200);
}

TEST(PosePlan, TheBestOfAllIsNoWorse) {
  const Chain robot = robots::thing();
  Generator rng(22);
  for (int i = 0; i < 20; ++i) {
    Instance instance = random_instance(robot, rng);
    const PosePlanner near(robot, robot.tool(), instance.options, {}, instance.obstacles);
    instance.options.global = true;
    const PosePlanner all(robot, robot.tool(), instance.options, {}, instance.obstacles);
    const PosePlan local = near.solve(instance.target, instance.seed.data());
    const PosePlan best = all.solve(instance.target, instance.seed.data());
    ASSERT_TRUE(best.success());
    expect_feasible(robot, instance, best.q);
    EXPECT_LE(best.objective, local.objective * (1 + 1e-9));
  }
}

// Inverse kinematics stalls at some seeds: the search over all goes on from its samples.
TEST(PosePlan, GlobalSearchDoesWithoutAnArrivalFromTheSeed) {
  const Chain robot = robots::thing();
  Generator rng(24);
  int stalled = 0;
  for (int i = 0; i < 200; ++i) {
    Instance instance = random_instance(robot, rng);
    instance.options.max_restarts = 0;
    const PosePlanner local(robot, robot.tool(), instance.options, {}, instance.obstacles);
    if (local.solve(instance.target, instance.seed.data()).position_error < 1e-3) {
      continue;
    }
    ++stalled;
    instance.options.global = true;
    const PosePlanner planner(robot, robot.tool(), instance.options, {}, instance.obstacles);
    const PosePlan best = planner.solve(instance.target, instance.seed.data());
    ASSERT_TRUE(best.success()) << i << ": " << message(planner, best);
    expect_feasible(robot, instance, best.q);
  }
  EXPECT_GT(stalled, 0);
}

// One step from a feasible seed: what is found is feasible, and said to be no more than that.
TEST(PosePlan, FeasibleIsNotConverged) {
  const Chain robot = robots::thing();
  Generator rng(23);
  int feasible = 0;
  for (int i = 0; i < 40; ++i) {
    Instance instance = random_instance(robot, rng);
    instance.options.max_iterations = 1;
    instance.options.max_restarts = 0;
    const PosePlanner planner(robot, robot.tool(), instance.options, {}, instance.obstacles);
    const PosePlan plan = planner.solve(instance.target, instance.drawn.data());
    if (plan.constraint_violation <= instance.options.tolerance) {
      ++feasible;
      EXPECT_EQ(plan.status, SolveStatus::kBudget);
      EXPECT_NE(message(planner, plan).find("feasible, but"), std::string::npos);
    }
  }
  EXPECT_GT(feasible, 10);
}

TEST(PosePlan, OutOfReachNamesTheHand) {
  const Chain robot = robots::thing();
  PosePlanOptions options;
  options.base_goal = Eigen::Vector2d(0, 0);
  options.base_radius = 0.3;
  const PosePlanner planner(robot, robot.tool(), options, {}, {});
  const JointVector seed = JointVector::Zero(9);
  SE3 target;
  target.translation = Eigen::Vector3d(5, 0, 1);
  const PosePlan plan = planner.solve(target, seed.data());
  EXPECT_EQ(plan.status, SolveStatus::kInfeasible);
  EXPECT_GT(plan.position_error, 2.5);
  EXPECT_NE(message(planner, plan).find("the hand's position"), std::string::npos);
}

TEST(PosePlan, DisjointDiscsNameTheClearance) {
  const Chain robot = robots::thing();
  PosePlanOptions options;
  options.base_goal = Eigen::Vector2d(0, 0);
  options.base_radius = 0.2;
  const std::vector<Obstacle> obstacles = {Disc{Eigen::Vector2d(0.1, 0), 0.5}};
  const PosePlanner planner(robot, robot.tool(), options, {}, obstacles);
  JointVector seed(9);
  seed << 0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0;
  const SE3 target = forward_kinematics(robot, seed.data(), robot.tool());
  const PosePlan plan = planner.solve(target, seed.data());
  EXPECT_EQ(plan.status, SolveStatus::kInfeasible);
  // The farthest the base gets within its disc is 0.3 m from the obstacle's middle.
  EXPECT_NEAR(plan.constraint_violation, 0.2, 0.02);
  EXPECT_NE(message(planner, plan).find("obstacle 0"), std::string::npos) << message(planner, plan);
}

}  // namespace
}  // namespace thing_kin
