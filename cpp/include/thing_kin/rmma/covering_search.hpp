#pragma once

#include <cstdint>

#include "thing_kin/rmma/base_estimator.hpp"
#include "thing_kin/rmma/side_search.hpp"

namespace thing_kin {

/// When the base's localization is read.
enum class OdometryUse : std::uint8_t { kContinuous, kFailure, kNone };

/// What the search is told of the robot; everything else it finds out or does not need.
struct CoveringDriveOptions {
  OdometryUse odometry = OdometryUse::kContinuous;
  double detection_radius = 0.012;  ///< m; better told too small than too large
  double u_max = 0.2;               ///< m: how far ahead of the base the arm is placed
  double reach = 0.45;              ///< m along x
};

/// Drives along one side: a bank of filters says where the tool would miss the fiducial, and a
/// CoveringSearch looks there, most probability per second first, until the fiducial is found or
/// leaves the arm's reach, or the next one is about to. The first is registered at rest.
void covering_search(WorldRun& run, const SearchPoints& side, double velocity,
                     const CoveringDriveOptions& options, NoiseMemory& memory, SideOutcome& out);

}  // namespace thing_kin
