#pragma once

// A room with a pillar, seen by a scanner that may move while it scans: exact ranges.

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "thing_kin/odometry/scan.hpp"

namespace thing_kin::test {

struct Wall {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

struct Disc2 {
  Eigen::Vector2d center;
  double radius;
};

struct ScanRoom {
  std::vector<Wall> walls;
  std::vector<Disc2> discs;
};

inline ScanRoom furnished_room() {
  return {.walls = {{{-4, -3}, {4, -3}},
                    {{4, -3}, {4, 2}},
                    {{4, 2}, {3, 3}},
                    {{3, 3}, {-4, 3}},
                    {{-4, 3}, {-4, -3}},
                    {{1, 1.5}, {1.8, 1.2}},
                    {{1.8, 1.2}, {2.1, 1.9}},
                    {{-1, -2}, {-0.2, -2}}},
          .discs = {{{2.5, -1.5}, 0.2}}};
}

inline ScanRoom endless_corridor() {
  return {.walls = {{{-900, -1}, {900, -1}}, {{-900, 1.2}, {900, 1.2}}}, .discs = {}};
}

inline double cross2(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

inline double range_along(const ScanRoom& room, const Eigen::Vector2d& o, double angle) {
  const Eigen::Vector2d d(std::cos(angle), std::sin(angle));
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : room.walls) {
    const Eigen::Vector2d along = wall.to - wall.from;
    const double range = cross2(wall.from - o, along) / cross2(d, along);
    const double share = cross2(wall.from - o, d) / cross2(d, along);
    if (range > 0.0 && share >= 0.0 && share <= 1.0) {
      nearest = std::min(nearest, range);
    }
  }
  for (const Disc2& disc : room.discs) {
    const double across = cross2(d, disc.center - o);
    const double half2 = disc.radius * disc.radius - across * across;
    const double range = d.dot(disc.center - o) - std::sqrt(std::max(half2, 0.0));
    if (half2 > 0.0 && range > 0.0) {
      nearest = std::min(nearest, range);
    }
  }
  return nearest;
}

// Ranges of a scan that begins at `pose`; the robot moves with `twist` meanwhile.
inline std::vector<double> ranges_in(const ScanRoom& room, const Scanner& scanner,
                                     const Pose2& pose, double noise = 0.0, unsigned seed = 0,
                                     const Twist2& twist = Twist2::Zero()) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<double> ranges;
  const double between_beams = scanner.scan_time / std::max(scanner.n - 1, 1);
  for (int beam = 0; beam < scanner.n; ++beam) {
    const Pose2 robot = compose(pose, se2_exp(twist * (beam * between_beams)));
    const Pose2 laser = compose(robot, scanner.mount);
    ranges.push_back(range_along(room, laser.head<2>(), laser.z() + scanner.angle(beam)) +
                     noise * normal(generator));
  }
  return ranges;
}

inline PlanarScan scan_in(const ScanRoom& room, const Scanner& scanner, const Pose2& pose,
                          double noise = 0.0, unsigned seed = 0) {
  PlanarScan scan;
  read_scan(scanner, ranges_in(room, scanner, pose, noise, seed), Twist2::Zero(), scan);
  return scan;
}

}  // namespace thing_kin::test
