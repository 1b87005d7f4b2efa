#pragma once

#include <vector>

#include "point_to_line.hpp"
#include "thing_kin/odometry/scan_matching.hpp"

namespace thing_kin {

/// Where a fit ended, and what it is worth: its fitness less a penalty for being off the guess.
struct Rival {
  Pose2 pose = Pose2::Zero();
  double merit = 0.0;
};

/// What the points' equations are off by, summed up: its covariance, and what is known of it. Lines
/// are means of a neighborhood: they lie behind what is round, and beside corners.
struct MatchSpread {
  Eigen::Matrix3d B = Eigen::Matrix3d::Zero();
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();
};

/// The scan's noise and, through the surfels, the map's, carried to the equations at a fit's pose;
/// or, where that is more, what residuals say: whether they are larger than noise explains, and how
/// much the fit hangs on single things (robust to clusters by leaving each out: Bell and McCaffrey
/// 2002). `hits` is memory.
MatchSpread spread_of(const LocalMap& map, const PlanarScan& scan, const Pose2& pose,
                      const PointToLine& normal, double noise, std::vector<Kept>& kept,
                      std::vector<int>& hits);

/// Covariances of a match, and what it leaves untold, from its equations' spread B.
void write_covariance(const Eigen::Matrix3d& B, const Directions& told,
                      const Eigen::Matrix3d& guess, ScanMatch& match);

/// Other fits that are nearly as good as the match, whose merit this is, may be the right ones: its
/// covariances then span them.
void span_rivals(const std::vector<Rival>& fits, double merit, ScanMatch& match);

}  // namespace thing_kin
