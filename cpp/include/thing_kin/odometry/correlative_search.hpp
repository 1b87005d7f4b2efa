#pragma once

#include <numbers>
#include <vector>

#include "thing_kin/odometry/local_map.hpp"

namespace thing_kin {

/// Where to look: so far in x and y, m, and in theta, rad, to both sides of a center.
struct SearchWindow {
  Pose2 center = Pose2::Zero();
  double translation = 0.6;
  double rotation = std::numbers::pi;
};

struct SearchCandidate {
  Pose2 pose = Pose2::Zero();
  double score = 0.0;  ///< 0 to 1: how near to the map the scan's points lie, on the mean
};

/// Poses in a window at which a scan lies near to the map: at most `most`, the best first, apart
/// from each other. Branch and bound over a grid of likelihoods (Olson 2009): the best on its grid
/// of 5 cm and 1 degree.
std::vector<SearchCandidate> correlative_search(const LocalMap& map, const PlanarScan& scan,
                                                const SearchWindow& window, int most);

}  // namespace thing_kin
