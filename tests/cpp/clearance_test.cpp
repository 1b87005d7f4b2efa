#include "thing_kin/kinematics/clearance.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/lie/so3.hpp"
#include "thing_kin/model/robots.hpp"

namespace thing_kin {
namespace {

std::vector<Obstacle> some_obstacles(bool with_disc) {
  std::vector<Obstacle> obstacles = {
      Sphere{{0.9, 0.2, 0.7}, 0.2}, Capsule{{1, -1, 0}, {1, -1, 2}, 0.1},
      Box{{so3_exp({0.1, 0.2, 0.3}), {-0.4, 1.5, 0.3}}, {0.3, 0.2, 0.4}},
      HalfSpace{Eigen::Vector3d(0.1, 0.2, 1.0).normalized(), -0.3}};
  if (with_disc) {
    obstacles.insert(obstacles.begin() + 1, Disc{{0.6, 0.6}, 0.4});
  }
  return obstacles;
}

LinkSpheres random_shape(const Chain& robot, test::Generator& rng) {
  LinkSpheres shape;
  for (const Chain::Frame& frame : robot.frames()) {
    shape.spheres.push_back({frame.name, test::random_vector(rng, 3, 0.3), 0.05});
  }
  for (int j = 1; std::cmp_less(j, shape.spheres.size()); ++j) {
    shape.pairs.emplace_back(j, j / 2);
  }
  return shape;
}

double value_at(const Clearances& clearances, const Chain& robot, const Eigen::VectorXd& q, int i) {
  Posture posture;
  place_joints(robot, q.data(), posture);
  return clearances.value(posture, q.data(), i);
}

JointVector gradient_at(const Clearances& clearances, const Chain& robot, const Eigen::VectorXd& q,
                        int i) {
  Posture posture;
  place_joints(robot, q.data(), posture);
  JointVector gradient;
  const double value = clearances.gradient(posture, q.data(), i, gradient);
  EXPECT_NEAR(value, clearances.value(posture, q.data(), i), 1e-13);
  return gradient;
}

template <typename Function>
auto slope(const Function& f) {
  constexpr double h = 1e-4;
  return ((8.0 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12.0 * h)).eval();
}

// Whether the Hessian is the same nearby, as it is where no corner of a box comes in.
bool is_smooth(const Clearances& clearances, const Chain& robot, const Eigen::VectorXd& q, int i) {
  const JointVector here = gradient_at(clearances, robot, q, i);
  const auto at = [&](int j, double h) -> JointVector {
    return gradient_at(clearances, robot, q + h * Eigen::VectorXd::Unit(robot.dof(), j), i);
  };
  for (int j = 0; j < robot.dof(); ++j) {
    if ((at(j, 1e-3) - 2.0 * here + at(j, -1e-3)).norm() > 3e-5) {
      return false;
    }
  }
  return true;
}

void expect_derivatives(const Chain& robot, const Clearances& clearances, const Eigen::VectorXd& q,
                        int& checked) {
  Posture posture;
  place_joints(robot, q.data(), posture);
  const int n = robot.dof();
  for (int i = 0; i < clearances.size(); ++i) {
    if (clearances.value(posture, q.data(), i) < 0.1 || !is_smooth(clearances, robot, q, i)) {
      continue;
    }
    ++checked;
    const JointVector gradient = gradient_at(clearances, robot, q, i);
    SmallMatrix H = SmallMatrix::Constant(n, n, 5.0);
    clearances.add_hessian(posture, q.data(), i, 2.0, H);
    for (int j = 0; j < n; ++j) {
      const Eigen::VectorXd e = Eigen::VectorXd::Unit(n, j);
      const auto value = [&](double h) {
        return Eigen::Matrix<double, 1, 1>(value_at(clearances, robot, q + h * e, i));
      };
      EXPECT_NEAR(slope(value)[0], gradient[j], 1e-8) << clearances.describe(i);
      const JointVector column = slope(
          [&](double h) -> JointVector { return gradient_at(clearances, robot, q + h * e, i); });
      EXPECT_LT(((H.col(j).array() - 5.0) / 2.0 - column.array()).matrix().norm(), 1e-6)
          << clearances.describe(i);
    }
  }
}

TEST(Clearance, DerivativesAreThoseOfTheValue) {
  test::Generator rng(3);
  int checked = 0;
  for (int i = 0; i < 30; ++i) {
    const Chain robot = i % 2 == 0 ? robots::thing() : test::random_chain(rng);
    const Clearances clearances(robot, random_shape(robot, rng), some_obstacles(i % 2 == 0));
    expect_derivatives(robot, clearances, test::random_vector(rng, robot.dof()), checked);
  }
  EXPECT_GT(checked, 700);
}

// The numbering, and each value by the library's own kinematics and distances.
TEST(Clearance, EachIsWhatItSays) {
  test::Generator rng(4);
  const Chain robot = robots::thing();
  const LinkSpheres shape = random_shape(robot, rng);
  const std::vector<Obstacle> obstacles = some_obstacles(true);
  const Clearances clearances(robot, shape, obstacles);
  const auto spheres = static_cast<int>(shape.spheres.size());
  ASSERT_EQ(clearances.size(), 4 * spheres + 1 + static_cast<int>(shape.pairs.size()));
  EXPECT_EQ(clearances.describe(0), "sphere 0 (" + robot.frames()[0].name + ") and obstacle 0");
  EXPECT_EQ(clearances.describe(spheres), "the base and obstacle 1");
  EXPECT_EQ(clearances.describe(spheres + 2), "sphere 1 (base_root) and obstacle 2");
  EXPECT_EQ(clearances.describe(clearances.size() - 1), "spheres 5 (mount) and 11 (tool)");

  const Eigen::VectorXd q = test::random_vector(rng, robot.dof());
  const auto center = [&](int i) {
    const LinkSphere& sphere = shape.spheres[static_cast<std::size_t>(i)];
    return forward_kinematics(robot, q.data(), robot.frame_index(sphere.frame)) * sphere.center;
  };
  int row = 0;
  for (const Obstacle& obstacle : obstacles) {
    if (std::holds_alternative<Disc>(obstacle)) {
      const double expected = (q.segment<2>(6) - Eigen::Vector2d(0.6, 0.6)).norm() - 0.4;
      EXPECT_NEAR(value_at(clearances, robot, q, row++), expected, 1e-14);
      continue;
    }
    for (int i = 0; i < spheres; ++i) {
      EXPECT_NEAR(value_at(clearances, robot, q, row++),
                  signed_distance_value(obstacle, center(i)) - 0.05, 1e-13);
    }
  }
  for (const auto& [i, j] : shape.pairs) {
    EXPECT_NEAR(value_at(clearances, robot, q, row++), (center(i) - center(j)).norm() - 0.1, 1e-13);
  }
}

TEST(Clearance, SpheresAlongTheArm) {
  const Chain robot = robots::thing();
  const LinkSpheres shape = spheres_along_links(robot, 0.1, 0.1);
  check(robot, shape);
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(9, -1.0, 1.0);
  // Points on the links, from joint to joint by frames of the chain, are covered.
  Posture posture;
  place_joints(robot, q.data(), posture);
  const auto nearest = [&](const Eigen::Vector3d& p) {
    double best = 1e9;
    for (const LinkSphere& sphere : shape.spheres) {
      const SE3 T = frame_pose(robot, posture, robot.frame_index(sphere.frame));
      best = std::min(best, (T * sphere.center - p).norm());
    }
    return best;
  };
  for (int joint = 3; joint < robot.dof(); ++joint) {
    const auto origin = [&](int k) -> Eigen::Vector3d {
      return k == robot.dof() ? frame_pose(robot, posture, robot.tool()).translation
                              : Eigen::Map<const Eigen::Vector3d>(posture.columns + 16 * k + 12);
    };
    for (const double t : {0.0, 0.3, 0.7, 1.0}) {
      EXPECT_LE(nearest(origin(joint) + t * (origin(joint + 1) - origin(joint))), 0.05 + 1e-12);
    }
  }
}

TEST(Clearance, PairsThatMayMeet) {
  // Links of 1, 1 and 1 m in a plane; the tip may meet the first link, never its own neighbor.
  std::vector<DhRow> rows(3);
  for (DhRow& row : rows) {
    row.a = 1.0;
    row.joint = JointType::kRevolute;
  }
  const Chain robot = Chain::from_dh(rows);
  const Eigen::Vector3d tip = Eigen::Vector3d::Zero();
  const auto pairs = [&](const std::vector<LinkSphere>& spheres) {
    return self_collision_pairs(robot, spheres);
  };
  using Pairs = std::vector<std::pair<int, int>>;
  EXPECT_EQ(pairs({{"frame1", tip, 0.1}, {"tool", tip, 0.1}}), (Pairs{{0, 1}}));
  EXPECT_EQ(pairs({{"frame2", tip, 0.1}, {"tool", tip, 0.1}}), Pairs{});
  EXPECT_EQ(pairs({{"tool", tip, 0.1}, {"tool", tip, 0.1}}), Pairs{});
  // The tip is 1 m at most from frame2, which stays 1 m from frame1 ...
  const Eigen::Vector3d side(0.0, 0.0, 3.0);
  EXPECT_EQ(pairs({{"frame1", side, 0.1}, {"tool", tip, 0.1}}), Pairs{});
  EXPECT_EQ(pairs({{"frame1", side, 0.7}, {"tool", tip, 0.5}}), (Pairs{{0, 1}}));
  // ... and always within 2 m.
  EXPECT_EQ(pairs({{"frame1", tip, 1.2}, {"tool", tip, 1.0}}), Pairs{});
}

TEST(Clearance, PairsAcrossASlide) {
  std::vector<DhRow> rows(3);
  rows[0].a = 1.0;
  rows[2].a = 1.0;
  rows[0].joint = rows[2].joint = JointType::kRevolute;
  rows[1].joint = JointType::kPrismatic;
  using Pairs = std::vector<std::pair<int, int>>;
  const std::vector<LinkSphere> spheres = {{"frame1", {0, 0, 5}, 0.1}, {"tool", {0, 0, 0}, 0.1}};
  EXPECT_EQ(self_collision_pairs(Chain::from_dh(rows), spheres), (Pairs{{0, 1}}));  // no limits
  rows[1].limits.lower = -3.0;
  rows[1].limits.upper = 3.0;
  EXPECT_EQ(self_collision_pairs(Chain::from_dh(rows), spheres), Pairs{});
}

TEST(Clearance, WhatDoesNotFit) {
  const Chain arm = robots::ur5();
  EXPECT_THROW(Clearances(arm, {}, {Disc{{0, 0}, 1.0}}), InvalidArgument);
  EXPECT_THROW(Clearances(arm, {}, {Sphere{{0, 0, 0}, -1.0}}), InvalidArgument);
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  EXPECT_THROW(Clearances(arm, {{{"no such frame", zero, 1.0}}, {}}, {}), InvalidArgument);
  EXPECT_THROW(Clearances(arm, {{{"tool", zero, 0.0}}, {}}, {}), InvalidArgument);
  EXPECT_THROW(Clearances(arm, {{{"tool", zero, 1.0}}, {{0, 1}}}, {}), InvalidArgument);
  EXPECT_THROW(Clearances(arm, {{{"tool", zero, 1.0}}, {{0, 0}}}, {}), InvalidArgument);
  EXPECT_THROW(spheres_along_links(arm, 0.0, 0.1), InvalidArgument);
  EXPECT_THROW(spheres_along_links(arm, 0.1, 0.0), InvalidArgument);
  std::vector<DhRow> far(2);
  far[0].joint = far[1].joint = JointType::kRevolute;
  far[0].a = 1e9;
  EXPECT_THROW(spheres_along_links(Chain::from_dh(far), 0.1, 0.1), InvalidArgument);
  EXPECT_EQ(Clearances(arm, {}, {}).size(), 0);
}

}  // namespace
}  // namespace thing_kin
