#include "thing_kin/odometry/scan_matching.hpp"

#include <array>
#include <cmath>
#include <thread>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "scan_room.hpp"

namespace thing_kin {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Scanner coarse_scanner() { return {.n = 361, .range_max = 30.0}; }

LocalMap map_of(const test::ScanRoom& room, const Pose2& pose) {
  LocalMap map;
  map.insert(test::scan_in(room, coarse_scanner(), pose, 0.01, 1), pose, 0.0);
  return map;
}

MatchGuess guess_of(const Pose2& pose) {
  return {.pose = pose, .covariance = Vector3d(0.04, 0.04, 0.09).asDiagonal()};
}

// What a match minimizes with the pairs that it has at `paired`: the loss of Geman and McClure over
// distances from lines (0.1 m) and places (0.2 m, half the weight), and a quarter of a point's pull
// towards the guess.
double cost_of(const LocalMap& map, const PlanarScan& scan, const Pose2& paired, const Pose2& pose,
               const Pose2& guess) {
  double sum = 0.5 * 0.25 * (pose - guess).head<2>().squaredNorm();
  for (const ScanPoint& point : scan) {
    const Eigen::Rotation2Dd at(paired.z());
    const Surfel* surfel = map.nearest(at * point.p + paired.head<2>(), at * point.normal, 0.15);
    if (surfel == nullptr ||
        (!surfel->is_surface() && point.surroundings == Surroundings::kSparse)) {
      continue;
    }
    const Vector2d away = Eigen::Rotation2Dd(pose.z()) * point.p + pose.head<2>() - surfel->line_p;
    const bool line = surfel->is_surface();
    const double e2 = line ? std::pow(surfel->line_normal.dot(away), 2) : away.squaredNorm();
    const double scale2 = line ? 0.01 : 0.04;
    sum += (line ? 0.5 : 0.25) * e2 / (1.0 + e2 / scale2);
  }
  return sum;
}

TEST(ScanMatching, EndsWhereTheGradientOfItsCostIsZero) {
  const test::ScanRoom room = test::furnished_room();
  const LocalMap map = map_of(room, Pose2::Zero());
  int converged = 0;
  for (unsigned seed = 2; seed < 12; ++seed) {
    const Pose2 truth(0.02 * seed, -0.1, 0.03 * seed);
    const PlanarScan scan = test::scan_in(room, coarse_scanner(), truth, 0.01, seed);
    const MatchGuess guess = guess_of(Pose2(0.1, 0.0, 0.1));
    const ScanMatch match = match_scan(map, scan, guess, {}, 0.01, {});
    EXPECT_EQ(match.degenerate, 0);
    EXPECT_LT(pose_difference(match.pose, truth).cwiseAbs().maxCoeff(), 0.02);
    if (match.status != MatchStatus::kConverged) {
      continue;  // between two sets of pairs
    }
    ++converged;
    Vector3d slope;
    Vector3d bend;
    for (int k = 0; k < 3; ++k) {
      const Vector3d d = 1e-4 * Vector3d::Unit(k);
      const auto cost = [&](const Pose2& pose) {
        return cost_of(map, scan, match.pose, pose, guess.pose);
      };
      const double ahead = cost(match.pose + d);
      const double behind = cost(match.pose - d);
      slope[k] = (ahead - behind) / 2e-4;
      bend[k] = (ahead - 2.0 * cost(match.pose) + behind) / 1e-8;
    }
    EXPECT_GT(bend.minCoeff(), 10.0);
    // The last step is below 1e-5, and scales converge linearly by a share of it.
    EXPECT_LT(slope.cwiseQuotient(bend).cwiseAbs().maxCoeff(), 1e-5);
  }
  EXPECT_GE(converged, 7);
}

TEST(ScanMatching, WhatIsUntoldStaysAsGuessed) {
  const test::ScanRoom room = test::endless_corridor();
  const LocalMap map = map_of(room, Pose2::Zero());
  const PlanarScan scan = test::scan_in(room, coarse_scanner(), {0.3, 0.05, 0.1}, 0.01, 3);
  const MatchGuess guess = guess_of(Pose2(0.2, 0.0, 0.0));
  const ScanMatch match = match_scan(map, scan, guess, {}, 0.01, {});
  ASSERT_EQ(match.degenerate, 1);
  const Vector3d v = match.untold.col(0);
  EXPECT_NEAR(v.norm(), 1.0, 1e-12);
  EXPECT_GT(std::abs(v.x()), 0.999);
  // The projector: idempotent, of rank two, blind along v (which counts theta by the arm).
  const Vector3d along(v.x(), v.y(), v.z() / match.arm);
  EXPECT_LT((match.told * match.told - match.told).norm(), 1e-12);
  EXPECT_NEAR(match.told.trace(), 2.0, 1e-12);
  EXPECT_LT((match.told * along).norm(), 1e-12);
  const Vector3d away = match.pose - guess.pose;
  EXPECT_NEAR(v.dot(Vector3d(1.0, 1.0, match.arm).cwiseProduct(away)), 0.0, 1e-3);
  EXPECT_NEAR(match.pose.y(), 0.05, 0.01);
  EXPECT_NEAR(match.pose.z(), 0.1, 0.005);
  // Both covariances are equal but along v.
  const Matrix3d extra = match.scan_covariance - match.covariance;
  EXPECT_LT((match.told * extra * match.told.transpose()).norm(), 1e-6);
  EXPECT_NEAR(extra.trace(), kUntoldVariance, 1e-2 * kUntoldVariance);
}

TEST(ScanMatching, WithoutContentTheGuessIsGivenBack) {
  const LocalMap map = map_of(test::furnished_room(), Pose2::Zero());
  const MatchGuess guess = guess_of(Pose2(0.1, 0.2, 0.3));
  const PlanarScan scan = test::scan_in(test::furnished_room(), coarse_scanner(), Pose2::Zero());
  const PlanarScan two(scan.begin(), scan.begin() + 2);
  const PlanarScan same(50, scan.front());
  const std::vector<std::pair<const LocalMap, PlanarScan>> cases = {
      {LocalMap(), scan}, {map, {}}, {map, two}};
  for (const auto& [in, what] : cases) {
    const ScanMatch match = match_scan(in, what, guess, {}, 0.01, {});
    EXPECT_EQ(match.status, MatchStatus::kTooFewPoints);
    EXPECT_EQ(match.pose, guess.pose);
    EXPECT_EQ(match.covariance, guess.covariance);
    EXPECT_EQ(match.degenerate, 3);
    EXPECT_TRUE(match.told.isZero(0.0));
  }
  // One place told fifty times tells at most two of three.
  const ScanMatch match = match_scan(map, same, guess, {}, 0.01, {});
  EXPECT_TRUE(match.pose.allFinite() && match.covariance.allFinite());
  EXPECT_GE(match.degenerate, 1);
}

TEST(ScanMatching, ManyThreadsReadOneMap) {
  const test::ScanRoom room = test::furnished_room();
  const LocalMap map = map_of(room, Pose2::Zero());
  const PlanarScan scan = test::scan_in(room, coarse_scanner(), {0.4, 0.3, 2.0}, 0.01, 5);
  MatchGuess guess = guess_of(Pose2(0.0, 0.0, 1.5));
  guess.covariance(2, 2) = 1.0;
  const MatchOptions options{.search_below = 1.0};  // with the search
  const ScanMatch alone = match_scan(map, scan, guess, {}, 0.01, options);
  EXPECT_TRUE(alone.searched);
  std::array<ScanMatch, 4> found;
  std::vector<std::thread> threads;
  threads.reserve(found.size());
  for (ScanMatch& one : found) {
    threads.emplace_back([&] { one = match_scan(map, scan, guess, {}, 0.01, options); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (const ScanMatch& one : found) {
    EXPECT_EQ(one.pose, alone.pose);
    EXPECT_EQ(one.covariance, alone.covariance);
    EXPECT_EQ(one.iterations, alone.iterations);
  }
}

}  // namespace
}  // namespace thing_kin
