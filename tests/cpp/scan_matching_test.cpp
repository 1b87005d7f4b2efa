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
    const Pose2 end = match.pose + match.drawn;  // the fit, before lines' pull was taken back
    Vector3d slope;
    Vector3d bend;
    for (int k = 0; k < 3; ++k) {
      const Vector3d d = 1e-4 * Vector3d::Unit(k);
      const auto cost = [&](const Pose2& pose) {
        return cost_of(map, scan, end, pose, guess.pose);
      };
      const double ahead = cost(end + d);
      const double behind = cost(end - d);
      slope[k] = (ahead - behind) / 2e-4;
      bend[k] = (ahead - 2.0 * cost(end) + behind) / 1e-8;
    }
    EXPECT_GT(bend.minCoeff(), 10.0);
    // The last step is below 1e-5, and scales converge linearly by a share of it.
    EXPECT_LT(slope.cwiseQuotient(bend).cwiseAbs().maxCoeff(), 1e-5);
  }
  EXPECT_GE(converged, 7);
}

// Two walls and places between them: the scan sees the walls as they are, the places d further
// back.
PlanarScan walls_and_places(double d) {
  PlanarScan scan;
  const auto add = [&](double x, double y, const Vector2d& normal) {
    scan.push_back(
        {.p = Vector2d(x, y),
         .normal = normal,
         .surroundings = normal.isZero(0.0) ? Surroundings::kCorner : Surroundings::kSurface});
  };
  for (int k = -10; k <= 10; ++k) {
    add(3.0, 0.1 * k, {-1.0, 0.0});
    add(0.1 * k, -3.0, {0.0, 1.0});
    add(1.0 - d, 0.2 * k, Vector2d::Zero());
  }
  return scan;
}

TEST(ScanMatching, APlaceCountsHalfAndReachesTwiceAsFar) {
  constexpr double kAway = 0.06;
  LocalMap map;
  map.insert(walls_and_places(0.0), Pose2::Zero(), 0.0);
  const ScanMatch match =
      match_scan(map, walls_and_places(kAway), guess_of(Pose2::Zero()), {}, 0.01, {});
  // By symmetry only x moves; there 21 of each and the guess's quarter of a point hold each other.
  const auto force = [&](double x) {
    const auto pull = [](double e, double scale) {
      return e / std::pow(1.0 + e * e / (scale * scale), 2);
    };
    return 21.0 * pull(x, 0.1) + 21.0 * 0.5 * pull(x - kAway, 0.2) + 0.25 * x;
  };
  double low = 0.0;
  double high = kAway;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (force(middle) < 0.0 ? low : high) = middle;
  }
  EXPECT_EQ(match.status, MatchStatus::kConverged);
  EXPECT_GT(low, 0.01);
  // The last step is below 1e-5.
  EXPECT_LT(pose_difference(match.pose, Pose2(low, 0.0, 0.0)).cwiseAbs().maxCoeff(), 1e-5);
}

// A line through an arc lies behind it: seen once more from the same place the pillars lie in front
// of their lines, and the fit alone is drawn by it.
TEST(ScanMatching, RoundThingsDrawNothing) {
  test::ScanRoom hall;
  for (const auto& [x, y] : {std::pair{2.0, 0.5}, {3.0, -1.0}, {2.5, 2.0}, {4.0, 1.0}}) {
    hall.discs.push_back({{x, y}, 0.3});
  }
  const Scanner scanner{.n = 1081, .range_max = 30.0};
  const PlanarScan scan = test::scan_in(hall, scanner, Pose2::Zero());
  LocalMap map;
  map.insert(scan, Pose2::Zero(), 0.0);
  const Pose2 truth(0.04, -0.03, 0.02);
  const PlanarScan other = test::scan_in(hall, scanner, truth);
  const ScanMatch match = match_scan(map, other, guess_of(Pose2::Zero()), {}, 0.01, {});
  EXPECT_EQ(match.degenerate, 0);
  EXPECT_GT(match.drawn.head<2>().norm(), 0.004);
  EXPECT_LT(pose_difference(match.pose, truth).head<2>().norm(), 0.002);
  EXPECT_GT(pose_difference(match.pose + match.drawn, truth).head<2>().norm(), 0.004);
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
