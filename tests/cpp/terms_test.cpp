// Every term's Jacobian and Hessian against differences of its value and Jacobian.

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/posture.hpp"
#include "thing_kin/lie/so3.hpp"
#include "thing_kin/model/robots.hpp"
#include "thing_kin/optimization/terms_base.hpp"
#include "thing_kin/optimization/terms_clearance.hpp"
#include "thing_kin/optimization/terms_dexterity.hpp"
#include "thing_kin/optimization/terms_joints.hpp"
#include "thing_kin/optimization/terms_orientation_cone.hpp"
#include "thing_kin/optimization/terms_pose.hpp"

namespace thing_kin {
namespace {

using Robot = std::shared_ptr<const Chain>;
using Recipes = std::vector<std::shared_ptr<const TermRecipe>>;

Eigen::VectorXd value_at(const Term& term, const Eigen::VectorXd& x) {
  Eigen::VectorXd value = Eigen::VectorXd::Constant(term.size(), 7.0);
  EXPECT_TRUE(term.evaluate(x, value, nullptr));
  return value;
}

Eigen::MatrixXd jacobian_at(const Term& term, const Eigen::VectorXd& x) {
  Eigen::VectorXd value(term.size());
  Eigen::MatrixXd J;
  EXPECT_TRUE(term.evaluate(x, value, &J));
  EXPECT_LT((value - value_at(term, x)).norm(), 1e-12 * (1.0 + value.norm()));
  return J;
}

// Central differences of fourth order.
template <typename Function>
auto slope(const Function& f, double h) {
  return ((8.0 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12.0 * h)).eval();
}

void expect_derivatives(const Term& term, const Eigen::VectorXd& x, test::Generator& rng,
                        double tolerance) {
  const Eigen::MatrixXd J = jacobian_at(term, x);
  ASSERT_EQ(J.rows(), term.size());
  ASSERT_EQ(J.cols(), x.size());
  const Eigen::VectorXd weights = test::random_vector(rng, term.size(), 1.0);
  Eigen::MatrixXd H = Eigen::MatrixXd::Constant(x.size(), x.size(), 3.0);
  term.add_hessian(x, weights, H);
  H.array() -= 3.0;
  const double h = 2e-4;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const Eigen::VectorXd e = Eigen::VectorXd::Unit(x.size(), j);
    const Eigen::VectorXd dvalue = slope([&](double s) { return value_at(term, x + s * e); }, h);
    EXPECT_LT((dvalue - J.col(j)).norm(), tolerance * (1.0 + J.norm())) << term.name() << " " << j;
    const Eigen::VectorXd row = slope(
        [&](double s) -> Eigen::VectorXd {
          return jacobian_at(term, x + s * e).transpose() * weights;
        },
        h);
    EXPECT_LT((row - H.col(j)).norm(), 10 * tolerance * (1.0 + H.norm()))
        << term.name() << " " << j << "\n"
        << row.transpose() << "\n"
        << H.col(j).transpose();
  }
}

SE3 random_pose(test::Generator& rng) {
  return {so3_exp(test::random_vector(rng, 3, 1.5)), test::random_vector(rng, 3, 1.0)};
}

Recipes of_any_robot(const Chain& robot, test::Generator& rng) {
  const SE3 target = random_pose(rng);
  const std::string frame = robot.frames()[robot.frames().size() / 2].name;
  const Eigen::Vector3d point = test::random_vector(rng, 3, 0.5);
  return {std::make_shared<terms::Pose>(target),
          std::make_shared<terms::Pose>(target, frame),
          std::make_shared<terms::Position>(target.translation, frame, point),
          std::make_shared<terms::Orientation>(target.rotation),
          std::make_shared<terms::OrientationCone>(point, target.translation),
          std::make_shared<terms::SeedDistance>(test::random_vector(rng, robot.dof()),
                                                test::random_vector(rng, robot.dof()).cwiseAbs()),
          std::make_shared<terms::JointCentering>()};
}

// Whether the logarithm stays away from half a turn, and the cone from its tips.
bool is_regular(const Term& term, const Eigen::VectorXd& x) {
  const Eigen::VectorXd value = value_at(term, x);
  if (term.name() == "orientation_cone") {
    return value[0] > 0.1 && value[0] < std::numbers::pi - 0.1;
  }
  if (term.name() == "pose" || term.name() == "orientation") {
    return value.tail<3>().norm() < std::numbers::pi - 0.01;
  }
  return true;
}

TEST(Terms, DerivativesForAnyRobot) {
  test::Generator rng(1);
  for (int i = 0; i < 60; ++i) {
    const Robot robot = std::make_shared<const Chain>(test::random_chain(rng));
    const Eigen::VectorXd q = test::random_vector(rng, robot->dof());
    for (const auto& recipe : of_any_robot(*robot, rng)) {
      const auto term = recipe->bind(robot);
      EXPECT_EQ(term->name(), recipe->name());
      EXPECT_EQ(term->variables(), robot->dof());
      if (is_regular(*term, q)) {
        expect_derivatives(*term, q, rng, 1e-9);
      }
    }
  }
}

TEST(Terms, DerivativesForTheThing) {
  test::Generator rng(2);
  const Robot robot = std::make_shared<const Chain>(robots::thing());
  const Eigen::VectorXd weights =
      (Eigen::VectorXd(9) << 1, 2, 0.5, 1, 1, 1, 0.3, 0.2, 0.1).finished();
  const Recipes recipes = {std::make_shared<terms::BaseDistance>(Eigen::Vector2d(0.3, -0.2)),
                           std::make_shared<terms::BasePosition>(Eigen::Vector2d(0.3, -0.2)),
                           std::make_shared<terms::Clearance>(
                               spheres_along_links(*robot, 0.1, 0.2),
                               std::vector<Obstacle>{Sphere{{9, 2, 0.5}, 0.1}, Disc{{4, 4}, 1.0}}),
                           std::make_shared<terms::Manipulability>(),
                           std::make_shared<terms::Manipulability>(terms::Arm{}),
                           std::make_shared<terms::ConditionNumber>(),
                           std::make_shared<terms::ConditionNumber>(weights),
                           std::make_shared<terms::Dexterity>(),
                           std::make_shared<terms::Dexterity>(terms::Arm{}),
                           std::make_shared<terms::Dexterity>(weights, "wrist_2")};
  for (int i = 0; i < 20; ++i) {
    Eigen::VectorXd q = test::random_vector(rng, 9);
    q[2] = 1.5;  // away from a straight elbow, where kappa grows without bound
    q[4] = 1.2;
    for (const auto& recipe : recipes) {
      expect_derivatives(*recipe->bind(robot), q, rng, 3e-8);
    }
  }
}

// From no error at all to nearly half a turn.
TEST(Terms, TheLogarithmAtItsEdges) {
  test::Generator rng(3);
  const Robot robot = std::make_shared<const Chain>(robots::thing());
  for (const double angle : {0.0, 1e-12, 1e-8, 1e-4, 0.999, 1.001, 2.0, 3.0, 3.13}) {
    for (int i = 0; i < 5; ++i) {
      const Eigen::VectorXd q = test::random_vector(rng, 9);
      SE3 target = forward_kinematics(*robot, q.data(), robot->tool());
      target.rotation = so3_exp(angle * test::random_vector(rng, 3).normalized()) * target.rotation;
      const auto pose = terms::Pose(target).bind(robot);
      EXPECT_NEAR(value_at(*pose, q).norm(), angle, 1e-14);
      expect_derivatives(*pose, q, rng, 1e-9);
    }
  }
}

TEST(Terms, TipsAndCentersAreFinite) {
  const Robot robot = std::make_shared<const Chain>(robots::thing());
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(9, -1.0, 1.0);
  const Eigen::Vector3d z = forward_kinematics(*robot, q.data(), robot->tool()).rotation.col(2);
  const auto ahead = terms::OrientationCone(Eigen::Vector3d::UnitZ(), z).bind(robot);
  EXPECT_LT(value_at(*ahead, q)[0], 1e-15);
  EXPECT_TRUE(jacobian_at(*ahead, q).isZero(0.0));
  const auto behind = terms::OrientationCone(Eigen::Vector3d::UnitZ(), -z).bind(robot);
  EXPECT_NEAR(value_at(*behind, q)[0], std::numbers::pi, 1e-15);
  EXPECT_GT(jacobian_at(*behind, q).norm(), 0.1);
  const auto center = terms::BaseDistance(q.segment<2>(6)).bind(robot);
  EXPECT_EQ(value_at(*center, q)[0], 0.0);
  EXPECT_EQ(jacobian_at(*center, q).norm(), 1.0);
  for (const auto& term : {ahead, behind, center}) {
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(9, 9);
    term->add_hessian(q, Eigen::VectorXd::Ones(1), H);
    EXPECT_TRUE(H.isZero(0.0));
  }
}

TEST(Terms, WhereTheRankIsLost) {
  const Robot arm = std::make_shared<const Chain>(robots::ur5());
  const Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  Eigen::VectorXd value(1);
  Eigen::MatrixXd J;
  EXPECT_FALSE(terms::ConditionNumber().bind(arm)->evaluate(q, value, nullptr));
  EXPECT_FALSE(terms::Dexterity().bind(arm)->evaluate(q, value, &J));
  EXPECT_TRUE(terms::Manipulability().bind(arm)->evaluate(q, value, &J));
  EXPECT_EQ(value[0], 0.0);
  EXPECT_TRUE(J.isZero(0.0));
}

TEST(Terms, WhatDoesNotFit) {
  const Robot arm = std::make_shared<const Chain>(robots::ur5());
  const Eigen::VectorXd nine = Eigen::VectorXd::Ones(9);
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  EXPECT_THROW(terms::Pose(SE3{}).bind(nullptr), InvalidArgument);
  EXPECT_THROW(terms::JointCentering().bind(nullptr), InvalidArgument);
  EXPECT_THROW(terms::Pose(SE3{}, "no such frame").bind(arm), InvalidArgument);
  EXPECT_THROW(terms::BaseDistance({0, 0}).bind(arm), InvalidArgument);
  EXPECT_THROW(terms::SeedDistance(nine).bind(arm), InvalidArgument);
  EXPECT_THROW(terms::Dexterity(nine).bind(arm), InvalidArgument);
  EXPECT_THROW(terms::Dexterity(Eigen::VectorXd::Unit(6, 1)).bind(arm), InvalidArgument);
  EXPECT_THROW(terms::Dexterity(-nine), InvalidArgument);
  EXPECT_THROW(terms::SeedDistance(nine, -nine), InvalidArgument);
  EXPECT_THROW(terms::SeedDistance(nine, zero), InvalidArgument);
  EXPECT_THROW(terms::OrientationCone(zero, zero), InvalidArgument);
  EXPECT_THROW(terms::Clearance({}, {Sphere{zero, 1.0}}), InvalidArgument);
  EXPECT_THROW(terms::Clearance({}, {Disc{{0, 0}, 1.0}}).bind(arm), InvalidArgument);
  EXPECT_EQ(terms::Clearance({}, {}).bind(arm)->size(), 0);
  EXPECT_EQ(terms::SeedDistance(nine).bind(nullptr)->variables(), 9);
}

}  // namespace
}  // namespace thing_kin
