#include "thing_kin/odometry/local_map.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "scan_room.hpp"

namespace thing_kin {
namespace {

using Eigen::Vector2d;

PlanarScan row_of(const std::vector<Vector2d>& points, const Vector2d& normal) {
  PlanarScan scan;
  for (const Vector2d& p : points) {
    scan.push_back(
        {.p = p,
         .normal = normal,
         .surroundings = normal.isZero(0.0) ? Surroundings::kCorner : Surroundings::kSurface});
  }
  return scan;
}

TEST(LocalMap, MergesWhatIsNearAndOfOneKind) {
  LocalMap map;
  map.insert(row_of({{1.0, 0.0}}, {-1.0, 0.0}), Pose2::Zero(), 0.0);
  map.insert(row_of({{1.02, 0.0}}, {-1.0, 0.0}), Pose2::Zero(), 1.0);
  ASSERT_EQ(map.surfels().size(), 1U);
  EXPECT_NEAR(map.surfels()[0].p.x(), 1.01, 1e-15);
  EXPECT_EQ(map.surfels()[0].weight, 2.0);
  EXPECT_EQ(map.surfels()[0].seen, 1.0);
  map.insert(row_of({{1.03, 0.0}}, {1.0, 0.0}), Pose2::Zero(), 1.0);  // a thin wall's other side
  map.insert(row_of({{1.01, 0.0}}, Vector2d::Zero()), Pose2::Zero(), 1.0);  // a place
  map.insert(row_of({{1.07, 0.0}}, {-1.0, 0.0}), Pose2::Zero(), 1.0);       // too far
  EXPECT_EQ(map.surfels().size(), 4U);
}

TEST(LocalMap, BridgesNeighborsOnOneWall) {
  const Vector2d facing(-1.0, 0.0);
  const auto of_two = [](const Vector2d& p, const Vector2d& q, const Vector2d& n, const Vector2d& m,
                         int beam) {
    PlanarScan scan = row_of({p}, n);
    scan.push_back(row_of({q}, m)[0]);
    scan[1].beam = beam;
    LocalMap map;
    map.insert(scan, Pose2::Zero(), 7.0);
    return map;
  };
  const LocalMap bridged = of_two({1.0, 0.0}, {1.01, 0.45}, facing, facing, 1);
  ASSERT_EQ(bridged.surfels().size(), 4U);
  for (const Surfel& surfel : bridged.surfels()) {
    EXPECT_NEAR(surfel.p.x(), 1.0 + 0.01 * surfel.p.y() / 0.45, 1e-12);
    EXPECT_EQ(surfel.seen, 7.0);
    EXPECT_EQ(surfel.weight, surfel.p.y() == 0.0 || surfel.p.y() == 0.45 ? 1.0 : 1.0 / 3.0);
  }
  EXPECT_NE(bridged.nearest({1.0, 0.225}, facing, 0.1), nullptr);

  const Vector2d aslant(-0.7, 0.7);
  EXPECT_EQ(of_two({1.0, 0.0}, {1.0, 0.45}, facing, facing, 3).surfels().size(), 2U);  // far beams
  EXPECT_EQ(of_two({1.0, 0.0}, {1.0, 1.05}, facing, facing, 1).surfels().size(), 2U);  // a gap
  EXPECT_EQ(of_two({1.0, 0.0}, {1.0, 0.15}, facing, facing, 1).surfels().size(), 2U);  // no need
  EXPECT_EQ(of_two({1.0, 0.0}, {1.2, 0.4}, facing, facing, 1).surfels().size(), 2U);   // a step
  const Vector2d below(0.0, -1.0);
  EXPECT_EQ(of_two({0.3, 0.5}, {0.75, 0.5}, below, below, 1).surfels().size(), 4U);
  EXPECT_EQ(of_two({3.0, 0.5}, {3.45, 0.5}, below, below, 1).surfels().size(),
            2U);  // may be a door
  EXPECT_EQ(of_two({1.0, 0.0}, {1.0, 0.45}, facing, aslant, 1).surfels().size(), 2U);
  EXPECT_EQ(of_two({1.0, 0.0}, {1.0, 0.45}, facing, Vector2d::Zero(), 1).surfels().size(), 2U);
}

TEST(LocalMap, KeepsNothingSparse) {
  LocalMap map;
  PlanarScan scan = row_of({{1.0, 0.0}}, Vector2d::Zero());
  scan[0].surroundings = Surroundings::kSparse;
  map.insert(scan, Pose2::Zero(), 0.0);
  EXPECT_TRUE(map.surfels().empty());
  EXPECT_EQ(map.nearest({1.0, 0.0}, Vector2d::Zero(), 1.0), nullptr);
}

TEST(LocalMap, FindsTheNearestOfAllThatFace) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> at(-6.0, 6.0);
  LocalMap map;
  const std::vector<Vector2d> normals = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {0, 0}};
  for (int k = 0; k < 400; ++k) {
    const Vector2d& normal = normals[static_cast<std::size_t>(k) % normals.size()];
    map.insert(row_of({{at(generator), at(generator)}}, normal), Pose2(1.0, 2.0, 0.0), k);
  }
  for (const bool forgotten : {false, true}) {
    if (forgotten) {
      map.forget({1.0, 2.0}, 5.0, 150.0);
      for (const Surfel& surfel : map.surfels()) {
        EXPECT_GE(surfel.seen, 150.0);
        EXPECT_LE((surfel.p - Vector2d(1.0, 2.0)).norm(), 5.0);
      }
      EXPECT_GT(map.surfels().size(), 50U);
    }
    int found = 0;
    int kept = 0;
    for (int k = 0; k < 2000; ++k) {
      const Vector2d p(at(generator) + 1.0, at(generator) + 2.0);
      const Vector2d& normal = normals[static_cast<std::size_t>(k) % normals.size()];
      const Surfel* expected = nullptr;
      double least = 0.4 * 0.4;
      for (const Surfel& surfel : map.surfels()) {
        const double distance2 = (surfel.p - p).squaredNorm();
        const bool faces = normal.isZero(0.0) || surfel.normal.dot(normal) >= 0.5;
        if (faces && distance2 < least) {
          least = distance2;
          expected = &surfel;
        }
      }
      EXPECT_EQ(map.nearest(p, normal, 0.4), expected);
      const auto [same, slack] = map.nearest_of_two(p, normal, 0.4);
      EXPECT_EQ(same, expected);
      if (same != nullptr) {  // it stays the nearest while p moves by less, wherever to
        const Vector2d way(std::cos(k), std::sin(k));
        EXPECT_EQ(map.nearest(p + 0.999 * slack * way, normal, 1.0), expected);
        kept += slack > 0.01 ? 1 : 0;
      }
      found += expected != nullptr ? 1 : 0;
    }
    EXPECT_GT(found, 100);
    EXPECT_GT(kept, 50);
  }
}

TEST(LocalMap, DrawsALineThroughANoisyWall) {
  const Scanner scanner{.n = 361, .range_max = 30.0};
  const test::ScanRoom wall{.walls = {{{3, -50}, {3, 50}}}, .discs = {}};
  LocalMap map;
  for (unsigned k = 0; k < 10; ++k) {
    map.insert(test::scan_in(wall, scanner, Pose2::Zero(), 0.01, k), Pose2::Zero(), k);
  }
  double points = 0.0;
  double lines = 0.0;
  int count = 0;
  for (const Surfel& surfel : map.surfels()) {
    if (surfel.is_surface() && std::abs(surfel.p.y()) < 2.0) {
      points += (surfel.p.x() - 3.0) * (surfel.p.x() - 3.0);
      const double across = surfel.line_normal.dot(surfel.p - surfel.line_p);
      const double x = surfel.p.x() - across * surfel.line_normal.x();
      lines += (x - 3.0) * (x - 3.0);
      EXPECT_GT(surfel.line_normal.dot(Vector2d(-1.0, 0.0)), 0.99);
      ++count;
    }
  }
  ASSERT_GT(count, 40);
  EXPECT_LT(lines, 0.25 * points);
}

TEST(LocalMap, ClearedItIsAsNew) {
  const Scanner scanner{.n = 181, .range_max = 30.0};
  const PlanarScan scan = test::scan_in(test::furnished_room(), scanner, Pose2::Zero(), 0.01, 1);
  LocalMap fresh;
  LocalMap used;
  used.insert(test::scan_in(test::furnished_room(), scanner, {1, 0, 2}, 0.01, 2), {1, 0, 2}, 0.0);
  used.clear();
  EXPECT_EQ(used.nearest({4.0, 0.0}, Vector2d::Zero(), 10.0), nullptr);
  fresh.insert(scan, Pose2::Zero(), 0.0);
  used.insert(scan, Pose2::Zero(), 0.0);
  ASSERT_EQ(fresh.surfels().size(), used.surfels().size());
  for (std::size_t k = 0; k < fresh.surfels().size(); ++k) {
    EXPECT_EQ(fresh.surfels()[k].p, used.surfels()[k].p);
    EXPECT_EQ(fresh.surfels()[k].line_normal, used.surfels()[k].line_normal);
    EXPECT_EQ(fresh.surfels()[k].line_p, used.surfels()[k].line_p);
  }
}

}  // namespace
}  // namespace thing_kin
