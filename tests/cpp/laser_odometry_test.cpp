#include "thing_kin/odometry/laser_odometry.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "scan_room.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Scanner moving_scanner() { return {.n = 361, .range_max = 30.0, .scan_time = 0.05}; }

constexpr double kStep = 0.1;  // s
const Twist2 kTwist(0.5, 0.05, 0.3);

Pose2 pose_at(int k) { return se2_exp(kTwist * (kStep * k)); }

std::vector<double> ranges_at(int k, const Scanner& scanner = moving_scanner()) {
  return test::ranges_in(test::furnished_room(), scanner, pose_at(k), 0.01,
                         static_cast<unsigned>(k), kTwist);
}

void expect_same(const LaserStep& a, const LaserStep& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.pose, b.pose);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.scan_covariance, b.scan_covariance);
  EXPECT_EQ(a.keyframe, b.keyframe);
}

TEST(LaserOdometry, FollowsAndChainsItsMotions) {
  LaserOdometry lidar(moving_scanner(), {});
  Pose2 chained = Pose2::Zero();
  for (int k = 0; k < 30; ++k) {
    const LaserStep step = lidar.add(ranges_at(k), kStep * k, std::nullopt);
    EXPECT_EQ(step.status, k == 0 ? LaserStatus::kFirst : LaserStatus::kTracking);
    chained = compose(chained, step.motion);
    EXPECT_LT(pose_difference(chained, step.pose).norm(), 1e-12);
    EXPECT_LT(pose_difference(step.pose, pose_at(k)).cwiseAbs().maxCoeff(), 0.02) << k;
  }
}

TEST(LaserOdometry, ACopyGoesOnAlike) {
  LaserOdometry lidar(moving_scanner(), {});
  for (int k = 0; k < 10; ++k) {
    lidar.add(ranges_at(k), kStep * k, std::nullopt);
  }
  LaserOdometry copy = lidar;
  for (int k = 10; k < 15; ++k) {
    const LaserStep one = lidar.add(ranges_at(k), kStep * k, std::nullopt);
    expect_same(copy.add(ranges_at(k), kStep * k, std::nullopt), one);
  }
}

TEST(LaserOdometry, ATimeThatIsRefusedChangesNothing) {
  LaserOdometry lidar(moving_scanner(), {});
  for (int k = 0; k < 5; ++k) {
    lidar.add(ranges_at(k), kStep * k, std::nullopt);
  }
  LaserOdometry twin = lidar;
  for (const double t : {0.4, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(lidar.add(ranges_at(9), t, std::nullopt), InvalidArgument);
  }
  expect_same(lidar.add(ranges_at(5), 0.5, std::nullopt),
              twin.add(ranges_at(5), 0.5, std::nullopt));
}

TEST(LaserOdometry, AMotionTakesTheErrorsOfBothItsPoses) {
  LaserOdometry lidar(moving_scanner(), {});
  std::optional<LaserStep> before;
  for (int k = 0; k < 12; k += 3) {
    const LaserStep step = lidar.add(ranges_at(k), kStep * k, std::nullopt);
    if (before && before->status == LaserStatus::kTracking) {
      Matrix3d by_a;
      Matrix3d by_b;
      for (int i = 0; i < 3; ++i) {
        const Vector3d d = 1e-6 * Vector3d::Unit(i);
        const Pose2& a = before->pose;
        const Pose2& b = step.pose;
        by_a.col(i) = pose_difference(between(a + d, b), between(a - d, b)) / 2e-6;
        by_b.col(i) = pose_difference(between(a, b + d), between(a, b - d)) / 2e-6;
      }
      const Matrix3d expected = by_a * before->match.covariance * by_a.transpose() +
                                by_b * step.match.covariance * by_b.transpose();
      EXPECT_LT((step.covariance - expected).norm(), 1e-7 * expected.norm());
      EXPECT_LT((step.scan_covariance - expected).norm(), 1e-7 * expected.norm());
    }
    before = step;
  }
}

TEST(LaserOdometry, BeginsAtTheFirstScanThatShowsSomething) {
  const Scanner scanner = moving_scanner();
  const std::vector<double> nothing(361, std::numeric_limits<double>::infinity());
  LaserOdometry lidar(scanner, {});
  EXPECT_EQ(lidar.add(nothing, 0.0, std::nullopt).status, LaserStatus::kLost);
  const PlanarEstimate moved{.pose = Pose2(0.1, 0.0, 0.2),
                             .covariance = 1e-4 * Matrix3d::Identity()};
  EXPECT_EQ(lidar.add(nothing, 0.1, moved).status, LaserStatus::kLost);
  const LaserStep first = lidar.add(ranges_at(0), 0.2, moved);
  EXPECT_EQ(first.status, LaserStatus::kFirst);
  EXPECT_TRUE(first.keyframe);
  EXPECT_LT(pose_difference(first.pose, compose(moved.pose, moved.pose)).norm(), 1e-15);
}

TEST(LaserOdometry, ForgetsWhatLiesBehind) {
  LaserOdometryOptions options;
  options.radius = 4.0;
  LaserOdometry lidar(moving_scanner(), options);
  for (int k = 0; k < 30; ++k) {
    const LaserStep step = lidar.add(ranges_at(k), kStep * k, std::nullopt);
    if (step.keyframe && step.status == LaserStatus::kTracking) {
      for (const Surfel& surfel : lidar.map().surfels()) {
        EXPECT_LE((surfel.p - step.pose.head<2>()).norm(), 4.0);
      }
    }
  }
}

}  // namespace
}  // namespace thing_kin
