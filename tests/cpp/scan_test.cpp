#include "thing_kin/odometry/scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "scan_room.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin {
namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;
constexpr double kNever = std::numeric_limits<double>::infinity();

Scanner fine_scanner() {
  return {.angle_min = -0.75 * kPi,
          .angle_max = 0.75 * kPi,
          .n = 1081,
          .range_max = 30.0,
          .mount = Pose2(0.3, -0.1, 0.4)};
}

TEST(Scan, PutsBeamsWhereTheyPoint) {
  for (const double sign : {1.0, -1.0}) {
    Scanner scanner = fine_scanner();
    scanner.angle_min *= sign;  // angles may fall
    scanner.angle_max *= sign;
    PlanarScan scan;
    read_scan(scanner, std::vector<double>(1081, 5.0), Twist2::Zero(), scan);
    ASSERT_EQ(scan.size(), 1081U);
    for (const ScanPoint& point : scan) {
      const double angle = 0.4 + scanner.angle(point.beam);
      const Vector2d expected(0.3 + 5.0 * std::cos(angle), -0.1 + 5.0 * std::sin(angle));
      // Directions are turned from beam to beam: 1081 rounding errors.
      EXPECT_LT((point.p - expected).norm(), 1e-12);
    }
  }
}

TEST(Scan, WhatMovesMeanwhileIsPutWhereTheFirstBeamSawIt) {
  Scanner scanner = fine_scanner();
  scanner.scan_time = 0.1;
  const Twist2 twist(0.8, -0.2, 1.5);
  const Pose2 pose(0.2, 0.1, 0.3);
  PlanarScan scan;
  read_scan(
      scanner,
      test::ranges_in({.walls = {{{3, -50}, {3, 50}}}, .discs = {}}, scanner, pose, 0.0, 0, twist),
      twist, scan);
  ASSERT_GT(scan.size(), 300U);
  for (const ScanPoint& point : scan) {
    const Pose2 at = compose(pose, Pose2(point.p.x(), point.p.y(), 0.0));
    EXPECT_NEAR(at.x(), 3.0, 1e-9);
    if (point.surroundings == Surroundings::kSurface) {
      const Vector2d normal = Eigen::Rotation2Dd(pose.z()) * point.normal;
      EXPECT_LT((normal - Vector2d(-1.0, 0.0)).norm(), 1e-6);
    }
  }
}

TEST(Scan, NoReturnIsNoPoint) {
  const Scanner scanner{.n = 9, .range_min = 0.1, .range_max = 10.0};
  PlanarScan scan;
  const std::vector<double> ranges = {std::nan(""), kNever, -kNever, 0.0, -1.0,
                                      0.0999,       10.0,   0.1,     9.9};
  read_scan(scanner, ranges, Twist2::Zero(), scan);
  ASSERT_EQ(scan.size(), 2U);  // range_min is a return, range_max none
  EXPECT_EQ(scan[0].beam, 7);
  EXPECT_EQ(scan[1].beam, 8);
}

TEST(Scan, SaysWhatLiesAroundAPoint) {
  const Scanner scanner{.n = 361, .range_max = 30.0};
  // Two walls that meet at (3, 0.5), and a pole of 1 cm in front: one beam or two.
  const test::ScanRoom room{.walls = {{{3, -8}, {3, 0.5}}, {{3, 0.5}, {1.5, 2.0}}},
                            .discs = {{{1.5, -1.5}, 0.01}}};
  const PlanarScan scan = test::scan_in(room, scanner, Pose2::Zero());
  const auto nearest = [&](const Vector2d& p) {
    return *std::ranges::min_element(scan, {},
                                     [&](const ScanPoint& s) { return (s.p - p).norm(); });
  };
  EXPECT_EQ(nearest({1.5, -1.5}).surroundings, Surroundings::kCorner);
  EXPECT_TRUE(nearest({1.5, -1.5}).normal.isZero(0.0));
  const ScanPoint wall = nearest({3.0, -0.5});
  EXPECT_EQ(wall.surroundings, Surroundings::kSurface);
  EXPECT_LT((wall.normal - Vector2d(-1.0, 0.0)).norm(), 1e-9);
  const ScanPoint slope = nearest({2.2, 1.3});
  EXPECT_EQ(slope.surroundings, Surroundings::kSurface);
  EXPECT_LT((slope.normal + Vector2d(std::sqrt(0.5), std::sqrt(0.5))).norm(), 1e-9);
  for (const ScanPoint& point : scan) {
    EXPECT_EQ(point.normal.isZero(0.0), point.surroundings != Surroundings::kSurface);
    EXPECT_LE(point.normal.dot(point.p), 0.0);  // towards the scanner
  }
}

TEST(Scan, NormalsBesideACornerAreTheWalls) {
  const Scanner scanner{.n = 361, .range_max = 30.0};
  const test::ScanRoom room{.walls = {{{1.5, -1.5}, {3, 0}}, {{3, 0}, {1.5, 1.5}}}, .discs = {}};
  int beside = 0;
  for (const ScanPoint& point : test::scan_in(room, scanner, Pose2::Zero())) {
    const double away = (point.p - Vector2d(3.0, 0.0)).norm();
    if (away > 0.06 && away < 0.4) {  // a beam from the corner, and within a normal's reach
      ++beside;
      const Vector2d own = Vector2d(-1.0, point.p.y() > 0.0 ? -1.0 : 1.0) * std::sqrt(0.5);
      EXPECT_LT((point.normal - own).norm(), 0.1) << point.p.transpose();
    }
  }
  EXPECT_GT(beside, 12);
}

TEST(Scan, NormalsOfRoundThingsAreRadial) {
  const Scanner scanner{.n = 1081, .range_max = 30.0};
  const Vector2d center(2.0, 0.3);
  const test::ScanRoom room{.walls = {}, .discs = {{center, 0.3}}};
  int facing = 0;
  for (const ScanPoint& point : test::scan_in(room, scanner, Pose2::Zero())) {
    const Vector2d radial = (point.p - center).normalized();
    if (point.surroundings == Surroundings::kSurface && -radial.dot(point.p.normalized()) > 0.4) {
      ++facing;
      EXPECT_GT(point.normal.dot(radial), std::cos(0.2));
    }
  }
  EXPECT_GT(facing, 60);
}

TEST(Scan, OneBeamAndNoneAreScans) {
  PlanarScan scan;
  read_scan({.n = 1}, std::vector<double>{2.0}, Twist2(1.0, 0.0, 1.0), scan);
  ASSERT_EQ(scan.size(), 1U);
  EXPECT_EQ(scan[0].surroundings, Surroundings::kSparse);
  read_scan({.n = 2}, std::vector<double>{kNever, kNever}, Twist2::Zero(), scan);
  EXPECT_TRUE(scan.empty());
}

TEST(Scan, AScannerThatCannotBeIsNamed) {
  Scanner scanner;
  scanner.n = 0;
  EXPECT_THROW(check_scanner(scanner), InvalidArgument);
  scanner = {.noise = -1.0};
  try {
    check_scanner(scanner);
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_EQ(std::string(error.what()).rfind("noise", 0), 0U);
  }
}

}  // namespace
}  // namespace thing_kin
