#pragma once

#include <cstdint>

#include "thing_kin/rmma/side_search.hpp"

namespace thing_kin {

/// The thesis's three ways to search.
enum class ThesisMethod : std::uint8_t { kSpiral, kLinearKf, kUkf };

/// Parameters of [X21] chapter 5; Q, R and P are variances.
struct ThesisOptions {
  double sample_gap = 0.005;  ///< m
  double q = 6e-8;       ///< added to each entry's variance, m^2 and (m/s)^2, at each prediction
  double r_hit = 4e-8;   ///< m^2
  double r_fail = 4e-4;  ///< m^2
  double p0 = 6e-8;      ///< variance of each entry at registration
  std::size_t draws = 200;
  std::size_t keep = 50;
  double spiral_gap = 0.005;  ///< m
  std::size_t spiral_count = 45;
  double u_max = 0.2;  ///< m: how far ahead of the base the arm is placed
};

/// Drives along one side. `key` is of the draws of (2.1). The first fiducial is registered at rest.
void thesis_search(WorldRun& run, const SearchPoints& side, double velocity, ThesisMethod method,
                   const ThesisOptions& options, std::uint64_t key, SideOutcome& out);

}  // namespace thing_kin
