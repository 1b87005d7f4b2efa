#include "thing_kin/model/obstacle.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin {
namespace {

Eigen::Vector3d random_point(test::Generator& rng, double bound = 2.0) {
  return test::random_vector(rng, 3, bound);
}

Obstacle random_obstacle(test::Generator& rng, int kind) {
  const double radius = test::uniform(rng, 0.05, 1.0);
  switch (kind) {
    case 0:
      return Disc{random_point(rng).head<2>(), radius};
    case 1:
      return Sphere{random_point(rng), radius};
    case 2:
      return Capsule{random_point(rng), random_point(rng), radius};
    case 3:
      return Box{{so3_exp(random_point(rng)), random_point(rng)},
                 (0.5 * random_point(rng)).cwiseAbs() + Eigen::Vector3d::Constant(0.1)};
    default:
      return HalfSpace{random_point(rng).normalized(), test::uniform(rng, -1, 1)};
  }
}

// Central differences of fourth order.
double slope(const std::function<double(double)>& f) {
  constexpr double h = 1e-4;
  return (8.0 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12.0 * h);
}

// The nearest kink of a distance: where its pieces meet, and its center or axis.
bool near_a_kink(const Obstacle& obstacle, const Eigen::Vector3d& p) {
  const SignedDistance here = signed_distance(obstacle, p);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double h : {-5e-3, 5e-3}) {
      const SignedDistance there = signed_distance(obstacle, p + h * Eigen::Vector3d::Unit(axis));
      const Eigen::Vector3d step = there.gradient - here.gradient;
      if ((step - h * here.hessian.col(axis)).norm() > 1e-3 ||
          (there.hessian - here.hessian).norm() > 0.5) {
        return true;
      }
    }
  }
  return false;
}

TEST(Obstacle, DerivativesAreThoseOfTheValue) {
  test::Generator rng(1);
  int checked = 0;
  for (int i = 0; i < 2000; ++i) {
    const Obstacle obstacle = random_obstacle(rng, i % 5);
    const Eigen::Vector3d p = random_point(rng);
    const SignedDistance at = signed_distance(obstacle, p);
    EXPECT_NEAR(at.value, signed_distance_value(obstacle, p), 1e-14);
    EXPECT_NEAR(at.gradient.norm(), 1.0, 1e-14);
    if (near_a_kink(obstacle, p)) {
      continue;
    }
    ++checked;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d e = Eigen::Vector3d::Unit(axis);
      EXPECT_NEAR(slope([&](double h) { return signed_distance_value(obstacle, p + h * e); }),
                  at.gradient[axis], 1e-9);
      for (int row = 0; row < 3; ++row) {
        EXPECT_NEAR(
            slope([&](double h) { return signed_distance(obstacle, p + h * e).gradient[row]; }),
            at.hessian(row, axis), 1e-8)
            << i;
      }
    }
  }
  EXPECT_GT(checked, 1500);
}

// Stepping back along the gradient by the distance leads onto the surface, outside of anything.
TEST(Obstacle, TheGradientLeadsToTheNearestPointOfTheSurface) {
  test::Generator rng(2);
  for (int i = 0; i < 1000; ++i) {
    const Obstacle obstacle = random_obstacle(rng, i % 5);
    const Eigen::Vector3d p = random_point(rng);
    const SignedDistance at = signed_distance(obstacle, p);
    EXPECT_NEAR(signed_distance_value(obstacle, p - at.value * at.gradient), 0.0, 1e-12) << i;
    // No point is nearer: the distance is 1-Lipschitz.
    const Eigen::Vector3d other = random_point(rng);
    EXPECT_LE(std::abs(signed_distance_value(obstacle, other) - at.value),
              (other - p).norm() + 1e-12);
  }
}

TEST(Obstacle, AtACenterAGradientIsGivenAllTheSame) {
  const Eigen::Vector3d c(0.3, -0.2, 0.5);
  for (const Obstacle& obstacle :
       {Obstacle(Disc{c.head<2>(), 0.4}), Obstacle(Sphere{c, 0.4}), Obstacle(Capsule{c, c, 0.4}),
        Obstacle(Capsule{c - Eigen::Vector3d::UnitX(), c + Eigen::Vector3d::UnitX(), 0.4}),
        Obstacle(Box{{Eigen::Matrix3d::Identity(), c}, Eigen::Vector3d(0.9, 0.4, 0.8)})}) {
    const SignedDistance at = signed_distance(obstacle, c);
    EXPECT_NEAR(at.value, -0.4, 1e-15);
    EXPECT_NEAR(at.gradient.norm(), 1.0, 1e-15);
    EXPECT_TRUE(at.hessian.isZero(0.0));
    EXPECT_GT(signed_distance_value(obstacle, c + 0.5 * at.gradient), 0.0);
  }
}

TEST(Obstacle, WhatIsNoShape) {
  const double nan = std::nan("");
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  for (const Obstacle& obstacle :
       {Obstacle(Disc{Eigen::Vector2d(nan, 0), 1.0}), Obstacle(Disc{Eigen::Vector2d(0, 0), 0.0}),
        Obstacle(Sphere{zero, -1.0}), Obstacle(Sphere{zero, nan}),
        Obstacle(Capsule{zero, zero, 0.0}), Obstacle(Box{{}, Eigen::Vector3d(1, 0, 1)}),
        Obstacle(Box{{2.0 * Eigen::Matrix3d::Identity(), zero}, Eigen::Vector3d(1, 1, 1)}),
        Obstacle(HalfSpace{Eigen::Vector3d(0, 0, 2), 0.0}),
        Obstacle(HalfSpace{Eigen::Vector3d::UnitX(), nan})}) {
    EXPECT_THROW(check(obstacle), InvalidArgument);
  }
  EXPECT_NO_THROW(check(Box{{}, Eigen::Vector3d(1, 1, 1)}));
}

}  // namespace
}  // namespace thing_kin
