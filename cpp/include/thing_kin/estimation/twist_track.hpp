#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <span>

#include "thing_kin/estimation/pose_belief.hpp"
#include "thing_kin/lie/se2.hpp"

namespace thing_kin {

/// The largest NIS that a gate accepts, by the number of entries.
using NisBound = std::array<double, 4>;
inline constexpr double kNoGate = std::numeric_limits<double>::infinity();

/// A measured twist: the mean over (start, t], held until the next. Its error is one draw from R:
/// over T = t - start it moves the pose by R T^2, over a part d of it by R T d, independent of the
/// other parts (white noise of density R T).
struct TwistSample {
  double t = 0.0;
  double start = -std::numeric_limits<double>::infinity();
  bool first = false;     ///< of its source: what it was before is a guess
  std::uint8_t mask = 7;  ///< bit k: whether entry k of (vx, vy, omega) is measured
  Twist2 z = Twist2::Zero();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  NisBound bound{};
  PoseVerdict verdict{true, 0.0, 0};
};

/// The samples of one source, in order of time; those older than the history are folded away but
/// for what later ones need.
struct TwistTrack {
  std::deque<TwistSample> samples;
  std::optional<TwistSample> held;     ///< the last accepted of the folded
  std::optional<double> folded_stamp;  ///< the last of the folded

  /// Index of the first sample after a.
  std::size_t after(double a) const noexcept;
  /// The last accepted sample before index `next`, or nullptr.
  const TwistSample* last_accepted(std::size_t next) const noexcept;
};

/// What a source says of a stretch.
struct TwistShare {
  const TwistSample* sample = nullptr;
  int rank = 0;            ///< 2: it covers the stretch; 1: held from before; 0: held from after
  double seconds = 0.0;    ///< R times this is the density of its noise, for the weights
  double increment = 0.0;  ///< R times this is what it adds over the stretch
};

/// The share of a track in (a, b], given the first sample after a and the beginning of time.
/// No sample where it has none.
TwistShare share_of(const TwistTrack& track, std::size_t next, double a, double b, double origin);

/// The shares of a stretch, weighted by their information: for each entry the highest rank there
/// is. An entry that nobody measures is zero.
struct TwistMix {
  Twist2 twist = Twist2::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the twist, as a sample's
  Eigen::Matrix3d increment = Eigen::Matrix3d::Zero();   ///< of the motion over the stretch
};
TwistMix mix(std::span<const TwistShare> shares) noexcept;

/// Compares a sample with what others measured in the same stretch, in the entries they share.
PoseVerdict judge(const TwistSample& sample, std::span<const TwistShare> others) noexcept;

}  // namespace thing_kin
