#include "thing_kin/lie/se2.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace thing_kin {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Vector3d random_triple(std::mt19937& generator, double most) {
  std::uniform_real_distribution<double> number(-most, most);
  return {number(generator), number(generator), number(generator)};
}

void expect_same_pose(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_LT(pose_difference(a, b).cwiseAbs().maxCoeff(), tolerance);
}

TEST(Se2, WrapsIntoTheHalfOpenTurn) {
  EXPECT_EQ(wrap_angle(kPi), kPi);
  EXPECT_EQ(wrap_angle(-kPi), kPi);
  EXPECT_EQ(wrap_angle(std::nextafter(-kPi, 0.0)), std::nextafter(-kPi, 0.0));
  EXPECT_EQ(wrap_angle(0.5), 0.5);
  EXPECT_NEAR(wrap_angle(2e4 * kPi + 0.5), 0.5, 1e-11);
}

TEST(Se2, IsAGroup) {
  std::mt19937 generator(1);
  for (int i = 0; i < 1000; ++i) {
    const Pose2 a = random_triple(generator, 4.0);
    const Pose2 b = random_triple(generator, 4.0);
    const Pose2 c = random_triple(generator, 4.0);
    expect_same_pose(compose(compose(a, b), c), compose(a, compose(b, c)), 1e-13);
    expect_same_pose(compose(a, inverse(a)), Pose2::Zero(), 1e-14);
    expect_same_pose(between(a, b), compose(inverse(a), b), 1e-13);
    expect_same_pose(compose(a, between(a, b)), b, 1e-13);
  }
}

TEST(Se2, ExpAndLogUndoEachOther) {
  std::mt19937 generator(2);
  for (const double angle : {0.0, 1e-300, 1e-12, 1e-4, 0.999, 1.001, 3.0, kPi - 1e-9, kPi}) {
    for (const double sign : {-1.0, 1.0}) {
      Twist2 xi = random_triple(generator, 3.0);
      xi.z() = sign * angle;
      const Twist2 again = se2_log(se2_exp(xi));
      if (sign > 0.0 || angle < kPi) {  // at half a turn omega is chosen positive
        EXPECT_LT((again - xi).cwiseAbs().maxCoeff(), 1e-14 * 10) << angle;
      }
      expect_same_pose(se2_exp(again), se2_exp(xi), 1e-14 * 10);
    }
  }
}

TEST(Se2, InversesOfJacobiansAreInverses) {
  std::mt19937 generator(3);
  for (int i = 0; i < 200; ++i) {
    const Twist2 xi = random_triple(generator, 5.0);
    const Eigen::Matrix3d left = se2_left_jacobian(xi) * se2_left_jacobian_inverse(xi);
    const Eigen::Matrix3d right = se2_right_jacobian_inverse(xi) * se2_right_jacobian(xi);
    EXPECT_LT((left - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((right - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-12);
  }
}

}  // namespace
}  // namespace thing_kin
