#pragma once

#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "thing_kin/rmma/world_run.hpp"
#include "thing_kin/search/spiral.hpp"

namespace thing_kin {

/// What drifts, errs and takes time in the simulated experiment, SI units; the defaults are the
/// standard world, a rounded fit to the spiral search's published rates. Drift is per distance.
struct World {
  static constexpr double kDegree = std::numbers::pi / 180.0;

  double slip_mean = 0.0;                  ///< share of the speed that is lost
  double slip_std = 0.017;                 ///< of it, from side to side
  double speed_std = 0.03;                 ///< of the speed's share, an Ornstein-Uhlenbeck process
  double speed_length = 0.15;              ///< m: its correlation length
  double heading_std = 0.4 * kDegree;      ///< rad, at the beginning of a side
  double curvature_mean = 0.3 * kDegree;   ///< rad/m
  double curvature_std = 0.55 * kDegree;   ///< rad/m, from side to side
  double heading_walk = 0.3 * kDegree;     ///< rad/sqrt(m)
  double start_lag = 0.1;                  ///< s before the base moves
  double creep = 0.0;                      ///< m/s to the left
  double arm_std = 0.0032;                 ///< m per axis after a move, seen by forward kinematics
  double arm_hidden_std = 0.0005;          ///< m per axis after a move, not seen
  double sample_std = 0.0005;              ///< m per axis at each stop, not seen
  double odo_bias_std = 0.004;             ///< m per axis, from side to side
  double odo_std = 0.007;                  ///< m per axis, an Ornstein-Uhlenbeck process
  double odo_length = 0.3;                 ///< m: its correlation length
  double odo_white = 0.001;                ///< m per axis and reading
  double odo_heading_std = 0.3 * kDegree;  ///< rad per reading
  double detection_radius = 0.012;         ///< m
  double sample_time = 0.16;               ///< s a stop
  double sample_speed = 0.18;              ///< m/s between stops
  double move_time = 0.5;                  ///< s
  double move_speed = 0.15;                ///< m/s
  double map_std = 0.0;                    ///< m per axis: where fiducials are, against the list
  double u_max = 0.2;                      ///< m: how far ahead the arm is placed
  double reach = 0.45;                     ///< m along x: a search ends beyond it
};

/// Throws InvalidArgument naming the first value that is out of range.
void check_world(const World& world);

/// Where the base stands when a side's first fiducial is registered: its tool's displacement.
inline Eigen::Vector2d first_displacement() noexcept { return {0.20, 0.60}; }

/// A drive in that world. `side`: fiducials as listed, (n) in the side's frame. The same key gives
/// the same drive, whatever is asked of it and in which order.
std::unique_ptr<WorldRun> start_run(const World& world, double velocity, const SearchPoints& side,
                                    std::uint64_t key);

}  // namespace thing_kin
