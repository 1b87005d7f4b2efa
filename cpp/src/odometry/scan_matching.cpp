#include "thing_kin/odometry/scan_matching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/LU>

#include "match_covariance.hpp"
#include "point_to_line.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/odometry/correlative_search.hpp"

namespace thing_kin {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Points look for the map within this distance at most, m; it shrinks to kLastDistance.
constexpr double kFirstDistance = 0.4;
constexpr double kShrink = 0.85;
// Until then so many points, evenly drawn, tell the way.
constexpr std::size_t kFewPoints = 60;
// A step below this (m, rad) comes from what is near already: what is far is left at once.
constexpr double kSettled = 0.02;
// The guess counts as so much of a point: it decides only what hardly anything else does.
constexpr double kPull = 0.25;
// A step below this (m, rad) ends the iteration.
constexpr double kMatchStep = 1e-5;
// Fitness that a start loses for each squared deviation from the guess; deviations have a floor, m
// and rad.
constexpr double kPenalty = 0.012;
constexpr double kFloor = 0.05;
constexpr double kFloorTurn = 0.1;
// A candidate of the search must be better than what is there by this factor.
constexpr double kBetter = 1.02;
constexpr int kCandidates = 4;

struct Fit {
  Pose2 pose;
  PointToLine normal;
  double merit = -std::numeric_limits<double>::infinity();  // fitness less the penalty
  int iterations = 0;
  bool converged = false;
};

class Matcher {
 public:
  Matcher(const LocalMap& map, const PlanarScan& scan, const MatchGuess& guess,
          const MatchOptions& options, std::vector<Kept>& kept)
      : map_(map), scan_(scan), guess_(guess), options_(options), kept_(kept) {
    assign_with_room(kept_, scan.size(), Kept{});
    Matrix3d P = guess.covariance;
    P.diagonal() += Vector3d(kFloor * kFloor, kFloor * kFloor, kFloorTurn * kFloorTurn);
    distrust_ = P.inverse();
    first_distance_ =
        std::clamp(3.0 * std::sqrt(std::max(P(0, 0), P(1, 1))), kLastDistance, kFirstDistance);
  }

  double fitness(const PointToLine& normal) const {
    return normal.agreement / static_cast<double>(scan_.size());
  }

  Fit fit(const Pose2& start) { return descend(start, first_distance_, nullptr); }

  // On from a fit, along directions that are told.
  Fit polish(const Pose2& start, const Directions& frozen) {
    return descend(start, kLastDistance, &frozen);
  }

 private:
  Fit descend(const Pose2& start, double distance, const Directions* frozen) {
    Fit fit{.pose = start, .normal = {}};
    for (;;) {
      const bool last = distance <= kLastDistance;
      const bool ends = fit.converged || fit.iterations == options_.max_iterations;
      const std::size_t few = std::max<std::size_t>(scan_.size() / kFewPoints, 1);
      fit.normal = point_to_line(map_, scan_, fit.pose, distance, last || ends ? 1 : few, kept_);
      if (ends) {
        break;
      }
      PointToLine pulled = fit.normal;
      pulled.A(0, 0) += kPull;
      pulled.A(1, 1) += kPull;
      pulled.g.head<2>() += kPull * (fit.pose - guess_.pose).head<2>();
      const Directions told(pulled, options_.degenerate_share);
      Vector3d step = told.step(pulled.g);
      if (frozen != nullptr) {
        step = frozen->along_told(step);
      }
      fit.pose += step;
      fit.pose.z() = wrap_angle(fit.pose.z());
      ++fit.iterations;
      fit.converged = last && step.norm() < kMatchStep;
      distance =
          step.norm() < kSettled ? kLastDistance : std::max(kShrink * distance, kLastDistance);
    }
    const Pose2 off = pose_difference(fit.pose, guess_.pose);
    const double asked = kPenalty * off.dot(distrust_ * off);
    fit.merit = fitness(fit.normal) - asked / (1.0 + asked / guess_.most_penalty);
    return fit;
  }

  const LocalMap& map_;
  const PlanarScan& scan_;
  const MatchGuess& guess_;
  const MatchOptions& options_;
  Matrix3d distrust_;
  double first_distance_ = kFirstDistance;
  std::vector<Kept>& kept_;
};

// What matching needs, kept from scan to scan so that none is allocated.
struct Workspace {
  PlanarScan thinned;
  std::vector<Kept> kept;
  std::vector<int> hits;
  std::vector<Rival> fits;
};

ScanMatch without_match(const MatchGuess& guess, MatchStatus status) {
  ScanMatch match;
  match.pose = guess.pose;
  match.covariance = guess.covariance;
  match.scan_covariance = Matrix3d::Identity() * kUntoldVariance;
  match.untold = Matrix3d::Identity();
  match.degenerate = 3;
  match.status = status;
  return match;
}

// Whether a scan has more points than `most`: so many of them are then in `some`.
bool thin(const PlanarScan& scan, int most, PlanarScan& some) {
  const std::size_t stride =
      (scan.size() + static_cast<std::size_t>(most) - 1) / static_cast<std::size_t>(most);
  if (stride <= 1) {
    return false;
  }
  some.clear();
  for (std::size_t i = 0; i < scan.size(); i += stride) {
    some.push_back(scan[i]);
  }
  return true;
}

SearchWindow window_around(const MatchGuess& guess) {
  const Vector3d sd = guess.covariance.diagonal().cwiseSqrt();
  return {.center = guess.pose,
          .translation = std::clamp(3.0 * sd.head<2>().maxCoeff(), 0.6, 2.0),
          .rotation = std::min(6.0 * sd.z() + 0.3, std::numbers::pi)};
}

}  // namespace

void check_match_options(const MatchOptions& options) {
  const auto check_share = [](double value, const char* name) {
    if (!(value >= 0.0 && value <= 1.0)) {
      throw InvalidArgument(name, text(value), "a number from 0 to 1");
    }
  };
  check_share(options.fitness_min, "fitness_min");
  check_share(options.search_below, "search_below");
  check_share(options.degenerate_share, "degenerate_share");
  if (options.max_iterations < 1) {
    throw InvalidArgument("max_iterations", std::to_string(options.max_iterations), "1 or more");
  }
  if (options.max_points < 3) {
    throw InvalidArgument("max_points", std::to_string(options.max_points), "3 or more");
  }
}

ScanMatch match_scan(const LocalMap& map, const PlanarScan& scan, const MatchGuess& guess,
                     std::span<const Pose2> starts, double noise, const MatchOptions& options) {
  thread_local Workspace workspace;
  const bool is_long = thin(scan, options.max_points, workspace.thinned);
  const PlanarScan& thinned = is_long ? workspace.thinned : scan;
  if (thinned.size() < 3 || map.surfels().empty()) {
    return without_match(guess, MatchStatus::kTooFewPoints);
  }
  Matcher matcher(map, thinned, guess, options, workspace.kept);
  Fit best = matcher.fit(guess.pose);
  int iterations = best.iterations;
  std::vector<Rival>& fits = workspace.fits;
  fits.assign(1, {.pose = best.pose, .merit = best.merit});
  const auto consider = [&](const Pose2& start, double factor) {
    Fit other = matcher.fit(start);
    iterations += other.iterations;
    fits.push_back({.pose = other.pose, .merit = other.merit});
    if (other.merit > best.merit + (factor - 1.0) * std::abs(best.merit)) {
      best = other;
    }
  };
  for (const Pose2& start : starts) {
    consider(start, 1.0);
  }
  const bool search = matcher.fitness(best.normal) < options.search_below;
  if (search) {
    for (const SearchCandidate& candidate :
         correlative_search(map, scan, window_around(guess), kCandidates)) {
      consider(candidate.pose, kBetter);
    }
  }
  ScanMatch match;
  const double fitness = matcher.fitness(best.normal);
  if (fitness < options.fitness_min) {
    match = without_match(guess, MatchStatus::kPoorFit);
  } else {
    const Directions told(best.normal, options.degenerate_share);
    if (told.untold > 0) {
      const Pose2 off = pose_difference(best.pose, guess.pose);
      const Fit polished = matcher.polish(guess.pose + told.along_told(off), told);
      best.pose = polished.pose;
      best.normal = polished.normal;
      iterations += polished.iterations;
    }
    match.pose = best.pose;
    match.status = best.converged ? MatchStatus::kConverged : MatchStatus::kIterationLimit;
    const MatchSpread spread =
        spread_of(map, thinned, best.pose, best.normal, noise, workspace.kept, workspace.hits);
    write_covariance(spread.B, told, guess.covariance, match);
    span_rivals(fits, best.merit, match);
    match.drawn = told.step(spread.pull);
    match.pose -= match.drawn;
    match.pose.z() = wrap_angle(match.pose.z());
  }
  match.fitness = fitness;
  match.inliers = static_cast<double>(best.normal.inliers) / static_cast<double>(thinned.size());
  match.residual = std::sqrt(best.normal.squares / std::max(best.normal.inliers, 1));
  match.points = static_cast<int>(thinned.size());
  match.iterations = iterations;
  match.searched = search;
  return match;
}

}  // namespace thing_kin
