#pragma once

#include <limits>
#include <span>
#include <vector>

#include "thing_kin/search/spiral.hpp"

namespace thing_kin {

/// A part of what is believed about a place in the plane.
struct PlanarNormal {
  double weight = 1.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// How a stop of the tool sees what it looks for at a distance d: surely, but for `lapse`, within
/// `sure` times the radius, never beyond `limit` times, linearly less between. A radius that is
/// told a little wrong, or a sight that sometimes fails, then costs a second look, not the search.
struct Sight {
  double radius = 0.0;  ///< m, > 0
  double sure = 0.8;
  double limit = 1.1;
  double lapse = 0.05;

  double probability(double squared_distance) const noexcept;
};

/// What a stop costs: s.
struct StopTime {
  double stop = 0.16;             ///< s
  double per_metre = 1.0 / 0.18;  ///< s/m

  double operator()(double distance) const noexcept { return stop + per_metre * distance; }
};

/// Looking for something whose place is believed to be a mixture of normals: at each step the stop
/// that finds most probability per second, among the points of a hexagonal lattice whose discs
/// cover the plane and the points between them; what a stop did not find is believed less there.
///
/// The region grows, up to `extent` from the mixture's mean, when what is in it has been looked at.
class CoveringSearch {
 public:
  /// No throw: arguments must have been checked.
  CoveringSearch(std::span<const PlanarNormal> belief, const Sight& sight, const StopTime& time,
                 double extent);

  /// Nothing was seen from there.
  void miss(const Eigen::Vector2d& at);

  /// The point to look at next from `from`; false if no point within the extent would find more
  /// than `least` per second. `allowed(point)` may say no.
  template <typename Allowed>
  bool next(const Eigen::Vector2d& from, double least, const Allowed& allowed,
            Eigen::Vector2d& point);

  /// The point that finds most, whatever the way there; false if none is allowed.
  template <typename Allowed>
  bool richest(const Allowed& allowed, Eigen::Vector2d& point);

  /// Probability that is left, of 1, within the region.
  double remaining() const noexcept { return remaining_; }
  /// Probability that a stop there would see it.
  double gain(const Eigen::Vector2d& at) const noexcept;
  /// Mean and covariance of where it is, given that it was seen from `at`, by the stops alone: the
  /// belief that one began with is not in them.
  PlanarNormal seen_from(const Eigen::Vector2d& at) const noexcept;

 private:
  struct Candidate {
    Eigen::Vector2d at;
    double gain = 0.0;
  };

  void build();
  bool grow();
  void take_away(const Eigen::Vector2d& at);
  template <typename Visit>
  void visit_seen(const Eigen::Vector2d& at, const Visit& visit) const;

  std::vector<PlanarNormal> belief_;
  Sight sight_;
  StopTime time_;
  double most_extent_, extent_, pitch_ = 0.0;
  Eigen::Vector2d center_, corner_;
  int cells_ = 0;             // along a side of the region
  std::vector<double> mass_;  // of each cell, (cells, cells)
  std::vector<Candidate> candidates_;
  SearchPoints misses_;
  double remaining_ = 1.0;
};

/// Where and when stops are possible.
struct CoveringWindow {
  SearchPoints within;  ///< a polygon, (k), k >= 3; empty: everywhere
  Eigen::Vector2d reach_center = Eigen::Vector2d::Zero();  ///< at time 0
  double reach_radius = kNoEnd;                            ///< m about it
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();      ///< m/s, of the reach's center
  double deadline = kNoEnd;                                ///< s: no stop is later

  static constexpr double kNoEnd = std::numeric_limits<double>::infinity();

  bool allows(const Eigen::Vector2d& point, double time) const noexcept;
};

/// A whole search in advance, as it goes if nothing is found.
struct CoveringPlan {
  SearchPoints points;
  std::vector<double> times;  ///< s, of the stops; the first is at 0
  std::vector<double> found;  ///< probability that it has been seen by then
};

/// Ends when nothing is left that would be found at `least` per second, or after `count` stops.
CoveringPlan plan_covering(std::span<const PlanarNormal> belief, const Sight& sight,
                           const StopTime& time, double extent, const CoveringWindow& window,
                           double least, std::size_t count);

template <typename Allowed>
bool CoveringSearch::next(const Eigen::Vector2d& from, double least, const Allowed& allowed,
                          Eigen::Vector2d& point) {
  do {
    double best = least;
    bool found = false;
    for (const Candidate& candidate : candidates_) {
      const double rate = candidate.gain / time_((candidate.at - from).norm());
      if (rate > best && allowed(candidate.at)) {
        best = rate;
        point = candidate.at;
        found = true;
      }
    }
    if (found) {
      return true;
    }
  } while (grow());
  return false;
}

template <typename Allowed>
bool CoveringSearch::richest(const Allowed& allowed, Eigen::Vector2d& point) {
  do {
    double best = 0.0;
    for (const Candidate& candidate : candidates_) {
      if (candidate.gain > best && allowed(candidate.at)) {
        best = candidate.gain;
        point = candidate.at;
      }
    }
    if (best > 0.0) {
      return true;
    }
  } while (grow());
  return false;
}

}  // namespace thing_kin
