#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "thing_kin/lie/se2.hpp"
#include "thing_kin/odometry/local_map.hpp"
#include "thing_kin/odometry/scan.hpp"

namespace thing_kin {

enum class MatchStatus : std::uint8_t {
  kConverged,
  kIterationLimit,  ///< the last step was not small yet
  kPoorFit,         ///< too little of the scan agrees with the map: not to be believed
  kTooFewPoints     ///< nothing to match
};

struct MatchOptions {
  double fitness_min = 0.35;        ///< below it a match is a poor fit
  double search_below = 0.75;       ///< below this fitness the correlative search looks elsewhere
  double degenerate_share = 0.005;  ///< of the points: less that tells a direction does not count
  int max_iterations = 30;
  int max_points = 1200;  ///< of a scan; more are thinned evenly
};

/// Where a scan may lie.
struct MatchGuess {
  Pose2 pose = Pose2::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x, y, theta), axes of the map
  /// Most fitness, of 1, that a fit loses for being far off: infinite for a guess that was
  /// measured.
  double most_penalty = 0.25;
};

/// How a scan lies in a map.
struct ScanMatch {
  Pose2 pose = Pose2::Zero();  ///< T_map_robot
  /// Of the pose, (x, y, theta) in the map's axes. What the scans don't tell has the variance of
  /// the guess, as the pose there is the guess's.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  /// The same, but what the scans don't tell has a variance that no use is in: to fuse with what
  /// the guess came from.
  Eigen::Matrix3d scan_covariance = Eigen::Matrix3d::Zero();
  MatchStatus status = MatchStatus::kTooFewPoints;
  /// Directions that the scans don't tell, (x, y, arm theta) in the map's axes: orthonormal
  /// columns.
  Eigen::Matrix3d untold = Eigen::Matrix3d::Zero();
  double arm = 1.0;    ///< m: the points' mean distance
  int degenerate = 0;  ///< how many they are
  /// Takes the untold directions away from a small motion.
  Eigen::Matrix3d told = Eigen::Matrix3d::Zero();
  /// What lines that lie behind round things, or beside corners, had drawn the fit by: already
  /// taken back in `pose`.
  Eigen::Vector3d drawn = Eigen::Vector3d::Zero();
  double fitness = 0.0;   ///< 0 to 1: how well the points agree with the map, on the mean
  double inliers = 0.0;   ///< share of the points that lie on the map
  double residual = 0.0;  ///< m, root mean square over the inliers
  int points = 0;
  int iterations = 0;
  bool searched = false;   ///< the correlative search was asked
  bool ambiguous = false;  ///< another pose fits nearly as well: the covariance spans both
};

/// Throws InvalidArgument naming the option.
void check_match_options(const MatchOptions& options);

/// Variance in m^2 or rad^2 of a direction that scans don't tell.
inline constexpr double kUntoldVariance = 1e4;

/// Aligns a scan to a map, point to line (Censi 2008) under a robust loss (Geman and McClure), from
/// each of the starts and, if no fit is good, from where a correlative search finds the scan
/// (Olson 2009). The best fit is kept; fits that are far off the guess by its covariance count
/// less. What the map's lines are known to draw it by is taken back, to first order. Directions
/// that the scans don't tell stay as in the guess. `noise`: of a range, m.
ScanMatch match_scan(const LocalMap& map, const PlanarScan& scan, const MatchGuess& guess,
                     std::span<const Pose2> starts, double noise, const MatchOptions& options);

}  // namespace thing_kin
