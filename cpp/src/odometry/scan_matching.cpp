#include "thing_kin/odometry/scan_matching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/spd.hpp"
#include "thing_kin/odometry/correlative_search.hpp"

namespace thing_kin {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Points look for the map within the first distance at most; it shrinks to the last, m.
constexpr double kFirstDistance = 0.4;
constexpr double kLastDistance = 0.15;
constexpr double kShrink = 0.85;
// A step below this (m, rad) comes from what is near already: what is far is left at once.
constexpr double kSettled = 0.02;
// Of the robust loss, m: a point so far off counts a quarter.
constexpr double kScale = 0.1;
// A place pulls along both axes, less than a line across its own, and from twice as far.
constexpr double kPlaceWeight = 0.5;
constexpr double kPlaceScale = 2.0 * kScale;
// The guess counts as so much of a point: it decides only what hardly anything else does.
constexpr double kPull = 0.25;
// A point that has turned by more, in rad, may face another surface.
constexpr double kKeptTurn = 0.01;
// A step below this (m, rad) ends the iteration.
constexpr double kMatchStep = 1e-5;
// Fitness that a start loses for each squared deviation from the guess; deviations have a floor, m
// and rad.
constexpr double kPenalty = 0.012;
constexpr double kFloor = 0.05;
constexpr double kFloorTurn = 0.1;
// A candidate of the search must be better than what is there by this factor.
constexpr double kBetter = 1.02;
// Points further apart, m, are of two things.
constexpr double kRunGap = 0.3;
constexpr int kCandidates = 4;

// What the points say at a pose: A step = -g.
struct Normal {
  Matrix3d A = Matrix3d::Zero();
  Vector3d g = Vector3d::Zero();
  double weight = 0.0;     // sum of the weights
  double arm2 = 0.0;       // sum of weight times squared distance
  double agreement = 0.0;  // of each point 0 to 1, summed
  double squares = 0.0;    // of the inliers' residuals
  double weighted_squares = 0.0;
  int inliers = 0;
};

struct Pairing {
  const Surfel* surfel;
  Vector2d arm;    // from the robot to the point, map axes
  Vector2d error;  // from the map to the point
};

// What a point was paired with, and where: kept while it can't be paired otherwise.
struct Kept {
  const Surfel* surfel = nullptr;
  double slack = -1.0;  // m; negative: to be searched
  Vector2d p = Vector2d::Zero();
  double theta = 0.0;
  double distance = 0.0;
};

// Its surfel within `distance`.
const Surfel* paired(const LocalMap& map, const Vector2d& p, const Vector2d& normal, double theta,
                     double distance, Kept& kept) {
  const double room = kept.surfel != nullptr ? kept.slack : kept.distance - distance;
  if (kept.slack < 0.0 || std::abs(theta - kept.theta) > kKeptTurn || room < 0.0 ||
      (p - kept.p).squaredNorm() > room * room) {
    const LocalMap::Nearest found = map.nearest_of_two(p, normal, distance);
    kept = {
        .surfel = found.surfel, .slack = found.slack, .p = p, .theta = theta, .distance = distance};
    return kept.surfel;
  }
  const bool near =
      kept.surfel != nullptr && (p - kept.surfel->p).squaredNorm() < distance * distance;
  return near ? kept.surfel : nullptr;
}

template <typename Visit>
void visit_pairs(const LocalMap& map, const PlanarScan& scan, const Pose2& pose, double distance,
                 std::vector<Kept>& kept, Visit&& visit) {
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(pose.z()).toRotationMatrix();
  for (std::size_t k = 0; k < scan.size(); ++k) {
    const ScanPoint& point = scan[k];
    const Vector2d arm = R * point.p;
    const Vector2d p = arm + pose.head<2>();
    const Surfel* surfel = paired(map, p, R * point.normal, pose.z(), distance, kept[k]);
    if (surfel != nullptr &&
        (surfel->is_surface() || point.surroundings != Surroundings::kSparse)) {
      visit(Pairing{.surfel = surfel, .arm = arm, .error = p - surfel->line_p});
    }
  }
}

// Calls row(J, e, w) for each equation of a pair; returns the agreement.
template <typename Row>
double equations(const Pairing& pair, Row&& row) {
  const Vector2d& n = pair.surfel->line_normal;
  const Vector2d& arm = pair.arm;
  if (pair.surfel->is_surface()) {
    const double e = n.dot(pair.error);
    const double share = 1.0 / (1.0 + e * e / (kScale * kScale));
    row(Vector3d(n.x(), n.y(), n.y() * arm.x() - n.x() * arm.y()), e, share * share);
    return share;
  }
  const double share = 1.0 / (1.0 + pair.error.squaredNorm() / (kPlaceScale * kPlaceScale));
  const double w = kPlaceWeight * share * share;
  row(Vector3d(1.0, 0.0, -arm.y()), pair.error.x(), w);
  row(Vector3d(0.0, 1.0, arm.x()), pair.error.y(), w);
  return share;
}

Normal normal_at(const LocalMap& map, const PlanarScan& scan, const Pose2& pose, double distance,
                 std::vector<Kept>& kept) {
  Normal sum;
  visit_pairs(map, scan, pose, distance, kept, [&](const Pairing& pair) {
    double worst = 0.0;
    const double agreement = equations(pair, [&](const Vector3d& J, double e, double w) {
      sum.A.noalias() += (w * J) * J.transpose();
      sum.g += (w * e) * J;
      sum.weight += w;
      sum.arm2 += w * pair.arm.squaredNorm();
      sum.weighted_squares += w * e * e;
      worst = std::max(worst, std::abs(e));
    });
    sum.agreement += agreement;
    if (worst < kScale) {
      ++sum.inliers;
      sum.squares += worst * worst;
    }
  });
  return sum;
}

// Directions in which theta counts by the points' distance; ascending in what is told of them.
struct Directions {
  Vector3d scale;   // what a unit is: 1 m, 1 m, 1/arm rad
  Vector3d told;    // sums of weights
  Matrix3d vector;  // columns
  int untold = 0;   // how many come first

  Directions(const Normal& normal, double share) : scale(1.0, 1.0, 1.0) {
    const double arm = std::sqrt(normal.arm2 / std::max(normal.weight, 1e-9));
    scale.z() = 1.0 / std::max(arm, 0.1);
    const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(scale.asDiagonal() * normal.A *
                                                        scale.asDiagonal());
    told = eigen.eigenvalues();
    vector = eigen.eigenvectors();
    const double least = std::max(share * normal.weight, 1e-6);
    untold = static_cast<int>((told.array() < least).count());
  }

  Vector3d step(const Vector3d& g) const {
    Vector3d d = Vector3d::Zero();
    const Vector3d scaled = scale.cwiseProduct(g);
    for (int k = untold; k < 3; ++k) {
      d -= vector.col(k) * (vector.col(k).dot(scaled) / told[k]);
    }
    return scale.cwiseProduct(d);
  }
};

// So many of it, and memory for twice as many: none is needed anew for each one more.
template <typename T>
void assign_with_room(std::vector<T>& values, std::size_t count, const T& value) {
  if (values.capacity() < count) {
    values.reserve(2 * count);
  }
  values.assign(count, value);
}

struct Fit {
  Pose2 pose;
  Normal normal;
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

  double fitness(const Normal& normal) const {
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
      fit.normal = normal_at(map_, scan_, fit.pose, distance, kept_);
      const bool last = distance <= kLastDistance;
      if (fit.converged || fit.iterations == options_.max_iterations) {
        break;
      }
      Normal pulled = fit.normal;
      pulled.A(0, 0) += kPull;
      pulled.A(1, 1) += kPull;
      pulled.g.head<2>() += kPull * (fit.pose - guess_.pose).head<2>();
      Directions told(pulled, options_.degenerate_share);
      Vector3d step = told.step(pulled.g);
      if (frozen != nullptr) {
        step = along_told(*frozen, step);
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

 public:
  static Vector3d along_told(const Directions& d, const Vector3d& step) {
    Vector3d y = step.cwiseQuotient(d.scale);
    for (int k = 0; k < d.untold; ++k) {
      y -= d.vector.col(k) * d.vector.col(k).dot(y);
    }
    return d.scale.cwiseProduct(y);
  }

 private:
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
};

// What the points' equations are off by, summed up: its covariance, and what is known of it. Lines
// are means of a neighborhood: they lie behind what is round, and beside corners.
struct MatchSpread {
  Matrix3d B = Matrix3d::Zero();
  Vector3d pull = Vector3d::Zero();
};

// The scan's noise and, through the surfels, the map's, carried to the pose; larger where residuals
// are larger than noise explains. What a row of neighboring points asks for together is an error of
// that thing: it does not average out (a covariance robust to clusters, Liang and Zeger 1986).
MatchSpread spread_of(const LocalMap& map, const PlanarScan& scan, const Fit& fit, double noise,
                      Workspace& workspace) {
  std::vector<Kept>& kept = workspace.kept;
  std::vector<int>& hits = workspace.hits;
  assign_with_room(hits, map.surfels().size(), 0);
  const auto index = [&](const Surfel* surfel) {
    return static_cast<std::size_t>(surfel - map.surfels().data());
  };
  visit_pairs(map, scan, fit.pose, kLastDistance, kept,
              [&](const Pairing& pair) { ++hits[index(pair.surfel)]; });
  MatchSpread spread;
  Matrix3d of_noise = Matrix3d::Zero();
  Vector3d force = Vector3d::Zero();
  Vector2d last = Vector2d::Zero();
  visit_pairs(map, scan, fit.pose, kLastDistance, kept, [&](const Pairing& pair) {
    if ((pair.arm - last).squaredNorm() > kRunGap * kRunGap) {
      spread.B += force * force.transpose();
      force.setZero();
    }
    last = pair.arm;
    // Points that share a surfel share its noise.
    const double shared = hits[index(pair.surfel)] / pair.surfel->weight;
    const double behind = pair.surfel->line_normal.dot(pair.surfel->p - pair.surfel->line_p);
    equations(pair, [&](const Vector3d& J, double e, double w) {
      of_noise.noalias() += (w * w * (1.0 + shared)) * J * J.transpose();
      force += w * e * J;
      spread.pull += w * behind * J;
    });
  });
  const double mean_square = fit.normal.weighted_squares / std::max(fit.normal.weight, 1e-9);
  spread.B += force * force.transpose() + of_noise * std::max(noise * noise, mean_square);
  return spread;
}

void write_covariance(const Matrix3d& B, const Directions& told, const Matrix3d& guess,
                      ScanMatch& match) {
  const Matrix3d B_scaled = told.scale.asDiagonal() * B * told.scale.asDiagonal();
  Matrix3d inverse = Matrix3d::Zero();
  for (int k = told.untold; k < 3; ++k) {
    inverse += told.vector.col(k) * told.vector.col(k).transpose() / told.told[k];
  }
  Matrix3d P = inverse * B_scaled * inverse;
  Matrix3d P_scan = P;
  const Vector3d unit = told.scale.cwiseInverse();
  for (int k = 0; k < told.untold; ++k) {
    const Vector3d v = told.vector.col(k);
    const Vector3d there = unit.cwiseProduct(v);
    P += v * v.transpose() * there.dot(guess * there);
    P_scan += v * v.transpose() * kUntoldVariance;
    match.untold.col(k) = v;
  }
  match.degenerate = told.untold;
  match.arm = unit.z();
  for (int i = 0; i < 3; ++i) {
    match.told.col(i) = Matcher::along_told(told, Vector3d::Unit(i));
  }
  const auto in_units = [&](const Matrix3d& scaled) {
    Matrix3d out = told.scale.asDiagonal() * scaled * told.scale.asDiagonal();
    out = (0.5 * (out + out.transpose())).eval();
    if (!is_positive(out)) {
      const Vector3d sizes = out.diagonal().cwiseMax(0.0);
      keep_positive(out, sizes);
    }
    return out;
  };
  match.covariance = in_units(P);
  match.scan_covariance = in_units(P_scan);
}

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
  const auto consider = [&](const Pose2& start, double factor) {
    Fit other = matcher.fit(start);
    iterations += other.iterations;
    if (other.merit > best.merit + (factor - 1.0) * std::abs(best.merit)) {
      best = other;
    }
  };
  for (const Pose2& start : starts) {
    consider(start, 1.0);
  }
  const bool search = matcher.fitness(best.normal) < options.search_below;
  if (search) {
    const Vector3d sd = guess.covariance.diagonal().cwiseSqrt();
    const SearchWindow window{.center = guess.pose,
                              .translation = std::clamp(3.0 * sd.head<2>().maxCoeff(), 0.6, 2.0),
                              .rotation = std::min(6.0 * sd.z() + 0.3, std::numbers::pi)};
    for (const SearchCandidate& candidate : correlative_search(map, scan, window, kCandidates)) {
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
      const Fit polished = matcher.polish(guess.pose + Matcher::along_told(told, off), told);
      best.pose = polished.pose;
      best.normal = polished.normal;
      iterations += polished.iterations;
    }
    match.pose = best.pose;
    match.status = best.converged ? MatchStatus::kConverged : MatchStatus::kIterationLimit;
    const MatchSpread spread = spread_of(map, thinned, best, noise, workspace);
    write_covariance(spread.B, told, guess.covariance, match);
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
