#pragma once

#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "thing_kin/lie/se2.hpp"

namespace thing_kin {

/// A planar laser scanner: where its beams go and what they can see. Angles in the scanner's frame,
/// from the first beam to the last; they may fall (a scanner that turns clockwise or hangs upside
/// down).
struct Scanner {
  double angle_min = -0.5 * std::numbers::pi;
  double angle_max = 0.5 * std::numbers::pi;
  int n = 181;
  double range_min = 0.0;  ///< m; what is nearer, or from range_max on, is no return
  double range_max = std::numeric_limits<double>::infinity();
  Pose2 mount = Pose2::Zero();  ///< T_robot_scanner
  double scan_time = 0.0;       ///< s, from the first beam to the last
  double noise = 0.01;          ///< m, one standard deviation of a range

  double increment() const noexcept { return n > 1 ? (angle_max - angle_min) / (n - 1) : 0.0; }
  double angle(int beam) const noexcept { return angle_min + increment() * beam; }

  bool operator==(const Scanner&) const = default;
};

/// Most beams of a scanner; largest range, in m, that a beam may return.
inline constexpr int kMostBeams = 65536;
inline constexpr double kMostRange = 1e4;

/// Throws InvalidArgument naming the scanner's field.
void check_scanner(const Scanner& scanner);

/// What lies around a point of a scan, which says what a match may take from it.
enum class Surroundings : std::uint8_t {
  kSurface,  ///< a line: tells how far off the point is across it
  kCorner,   ///< near others that are no line, or a thing thinner than the beams are apart: a place
  kSparse    ///< neighbors too far away to tell: may lie on a known surface, is no place itself
};

struct ScanPoint {
  Eigen::Vector2d p;       ///< m, in the robot's frame
  Eigen::Vector2d normal;  ///< of the surface, towards the scanner; zero if there is none
  Surroundings surroundings = Surroundings::kSparse;
  int beam = 0;
};

/// The beams that returned, in their order. REP 117: -inf is too near, +inf no return, NaN an
/// error; none of them is a point.
using PlanarScan = std::vector<ScanPoint>;

/// The robot's twist at the first beam and at the last; between them it changes evenly.
struct ScanMotion {
  Twist2 first = Twist2::Zero();
  Twist2 last = Twist2::Zero();
};

/// out <- the points of a scan in the frame that the robot has at its first beam, while it moves.
/// `out` keeps its memory.
void read_scan(const Scanner& scanner, std::span<const double> ranges, const ScanMotion& motion,
               PlanarScan& out);

/// The same with a constant twist.
void read_scan(const Scanner& scanner, std::span<const double> ranges, const Twist2& twist,
               PlanarScan& out);

}  // namespace thing_kin
