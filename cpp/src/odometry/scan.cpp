#include "thing_kin/odometry/scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

using Eigen::Vector2d;

// Neighbors that make a line lie within a radius, in m, that the noise asks for, at most so much;
// or within so many steps of the beams.
constexpr double kNormalRadius = 0.3;
constexpr double kNormalSteps = 5.0;
// One standard deviation, in rad, that noise may turn a normal by.
constexpr double kNormalNoise = 0.025;
// At most so many to each side.
constexpr int kNormalReach = 64;
// Neighbors further apart than this, in m, or than so many steps of the beams, are not of one
// surface.
constexpr double kGap = 0.12;
constexpr double kGapSteps = 4.0;
// A surface is flat to this, in m, root mean square.
constexpr double kFlatness = 0.05;
// Of the noise: a line's points are off by no more, root mean square.
constexpr double kFlatNoise = 1.5;
// A thing thinner than the beams' distance stands before what is behind it by this, in m.
constexpr double kForeground = 0.1;

void check_scanner_angle(double value, const char* name) {
  if (!(std::abs(value) <= 4.0 * std::numbers::pi)) {
    throw InvalidArgument(name, text(value), "an angle in rad, at most 4 pi in size");
  }
}

// Whether beams are beside each other, on one surface as far as their distance tells.
bool connected(const ScanPoint& a, const ScanPoint& b, double range, double step) {
  const double gap = std::max(kGap, kGapSteps * step * range);
  return std::abs(a.beam - b.beam) <= 2 && (a.p - b.p).squaredNorm() <= gap * gap;
}

// Of a window to each side in which points as far apart as `spacing` give a line its direction as
// well as kNormalNoise says: sigma sqrt(3 / n) / radius, n = 2 radius / spacing.
double normal_radius(double noise, double spacing) {
  const double ratio = noise * std::numbers::sqrt3 / kNormalNoise;
  const double asked = std::cbrt(ratio * ratio * 0.5 * spacing);
  return std::max(std::min(asked, kNormalRadius), kNormalSteps * spacing);
}

struct Neighbors {
  std::size_t first;
  std::size_t last;
};

Neighbors neighbors_of(const PlanarScan& scan, std::span<const double> ranges, std::size_t i,
                       double step, double noise) {
  const auto range = [&](std::size_t k) { return ranges[static_cast<std::size_t>(scan[k].beam)]; };
  const double radius = normal_radius(noise, step * range(i));
  const auto belongs = [&](std::size_t k, std::size_t to) {
    return connected(scan[k], scan[to], std::max(range(k), range(to)), step) &&
           (scan[k].p - scan[i].p).squaredNorm() < radius * radius;
  };
  Neighbors found{.first = i, .last = i};
  for (int k = 0; k < kNormalReach && found.first > 0 && belongs(found.first - 1, found.first);
       ++k) {
    --found.first;
  }
  for (int k = 0;
       k < kNormalReach && found.last + 1 < scan.size() && belongs(found.last + 1, found.last);
       ++k) {
    ++found.last;
  }
  return found;
}

// Sums over the points up to one, from a first one: of any row of neighbors by a difference.
struct Sums {
  double n = 0.0;
  Vector2d p = Vector2d::Zero();
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;

  void add(const Vector2d& q) {
    n += 1.0;
    p += q;
    xx += q.x() * q.x();
    xy += q.x() * q.y();
    yy += q.y() * q.y();
  }
};

// The direction across the points between two sums, and the variance of the points in it.
double fit_across(const Sums& first, const Sums& last, Vector2d& across) {
  const double n = last.n - first.n;
  const Vector2d mean = (last.p - first.p) / n;
  const double xx = (last.xx - first.xx) / n - mean.x() * mean.x();
  const double xy = (last.xy - first.xy) / n - mean.x() * mean.y();
  const double yy = (last.yy - first.yy) / n - mean.y() * mean.y();
  const double half = 0.5 * (xx - yy);
  const double root = std::sqrt(half * half + xy * xy);
  // Along the points, from whichever column of C - lambda_min I is longer.
  const Vector2d along = half > 0.0 ? Vector2d(half + root, xy) : Vector2d(xy, root - half);
  across = Vector2d(-along.y(), along.x()).normalized();
  return std::max(0.5 * (xx + yy) - root, 0.0);
}

// The line of as many neighbors as lie on one: of both sides, of one, of half as many.
bool fit_line(const std::vector<Sums>& sums, Neighbors near, std::size_t i, double noise,
              Vector2d& across) {
  const double flat2 = kFlatNoise * kFlatNoise * noise * noise;
  const auto variance = [&](std::size_t first, std::size_t last, Vector2d& out) {
    return last - first < 2 ? std::numeric_limits<double>::infinity()
                            : fit_across(sums[first], sums[last + 1], out);
  };
  for (;;) {
    const double both = variance(near.first, near.last, across);
    if (both <= flat2) {
      return true;
    }
    Vector2d left;
    Vector2d right;
    const double before = variance(near.first, std::min(i + 1, near.last), left);
    const double after = variance(std::max(i, near.first + 1) - 1, near.last, right);
    if (std::min(before, after) <= flat2) {
      across = before < after ? left : right;
      return true;
    }
    const Neighbors half{.first = i - (i - near.first) / 2, .last = i + (near.last - i) / 2};
    if (half.last - half.first < 2) {
      return both <= kFlatness * kFlatness;
    }
    near = half;
  }
}

// Both sides are further away: the beams of this thing fell on nothing else.
bool stands_alone(const PlanarScan& scan, std::span<const double> ranges, const Neighbors& own) {
  if (own.first == 0 || own.last + 1 == scan.size()) {
    return false;
  }
  const auto range = [&](std::size_t k) { return ranges[static_cast<std::size_t>(scan[k].beam)]; };
  return range(own.first - 1) > range(own.first) + kForeground &&
         range(own.last + 1) > range(own.last) + kForeground;
}

double between_beams(const Scanner& scanner) {
  return scanner.n > 1 ? scanner.scan_time / (scanner.n - 1) : 0.0;
}

// Calls visit(beam, origin, direction), beam by beam, while the robot's twist stays.
template <typename Visit>
void visit_beams(const Scanner& scanner, const Twist2& twist, Visit&& visit) {
  // From beam to beam the scanner moves by the same small motion, and the beam turns by more.
  const Pose2 motion = se2_exp(twist * between_beams(scanner));
  const Eigen::Matrix2d moved = Eigen::Rotation2Dd(motion.z()).toRotationMatrix();
  const Eigen::Matrix2d turned =
      Eigen::Rotation2Dd(motion.z() + scanner.increment()).toRotationMatrix();
  const double first = scanner.mount.z() + scanner.angle_min;
  Vector2d origin = scanner.mount.head<2>();
  Vector2d direction(std::cos(first), std::sin(first));
  for (int beam = 0; beam < scanner.n; ++beam) {
    visit(beam, origin, direction);
    origin = (moved * origin + motion.head<2>()).eval();
    direction = (turned * direction).eval();
  }
}

// The same while it changes evenly.
template <typename Visit>
void visit_beams(const Scanner& scanner, const ScanMotion& motion, Visit&& visit) {
  const Twist2 change = (motion.last - motion.first) / std::max(scanner.n - 1, 1);
  Pose2 robot = Pose2::Zero();
  for (int beam = 0; beam < scanner.n; ++beam) {
    const Pose2 laser = compose(robot, scanner.mount);
    const double angle = laser.z() + scanner.angle(beam);
    visit(beam, Vector2d(laser.head<2>()), Vector2d(std::cos(angle), std::sin(angle)));
    const Twist2 twist = motion.first + (beam + 0.5) * change;
    robot = compose(robot, se2_exp(twist * between_beams(scanner)));
  }
}

// out <- the returns; their normals hold the beam's direction until they are known.
void place_points(const Scanner& scanner, std::span<const double> ranges, const ScanMotion& motion,
                  PlanarScan& out) {
  out.clear();
  const double farthest = std::min(scanner.range_max, kMostRange);
  const auto place = [&](int beam, const Vector2d& origin, const Vector2d& direction) {
    const double range = ranges[static_cast<std::size_t>(beam)];
    if (range > 0.0 && range >= scanner.range_min && range < farthest) {
      out.push_back({.p = origin + range * direction, .normal = direction, .beam = beam});
    }
  };
  if (scanner.scan_time == 0.0 || motion.first == motion.last) {
    visit_beams(scanner, motion.first, place);
  } else {
    visit_beams(scanner, motion, place);
  }
}

}  // namespace

void check_scanner(const Scanner& scanner) {
  check_scanner_angle(scanner.angle_min, "angle_min");
  check_scanner_angle(scanner.angle_max, "angle_max");
  if (scanner.n < 1 || scanner.n > kMostBeams) {
    throw InvalidArgument("n", std::to_string(scanner.n), "1 to 65536 beams");
  }
  if (scanner.n > 1 && scanner.angle_min == scanner.angle_max) {
    throw InvalidArgument("angle_max", text(scanner.angle_max), "another angle than angle_min");
  }
  if (!(scanner.range_min >= 0.0 && std::isfinite(scanner.range_min))) {
    throw InvalidArgument("range_min", text(scanner.range_min), "a finite number >= 0");
  }
  if (!(scanner.range_max > scanner.range_min)) {
    throw InvalidArgument("range_max", text(scanner.range_max), "a number > range_min");
  }
  if (!scanner.mount.allFinite() || scanner.mount.cwiseAbs().maxCoeff() > kMostRange) {
    throw InvalidArgument("mount", "an entry that is not finite or over 1e4", "a moderate pose");
  }
  if (!(scanner.scan_time >= 0.0 && std::isfinite(scanner.scan_time))) {
    throw InvalidArgument("scan_time", text(scanner.scan_time), "a finite number of seconds >= 0");
  }
  if (!(scanner.noise > 0.0 && std::isfinite(scanner.noise))) {
    throw InvalidArgument("noise", text(scanner.noise), "a finite number of metres > 0");
  }
}

void read_scan(const Scanner& scanner, std::span<const double> ranges, const Twist2& twist,
               PlanarScan& out) {
  read_scan(scanner, ranges, ScanMotion{.first = twist, .last = twist}, out);
}

void read_scan(const Scanner& scanner, std::span<const double> ranges, const ScanMotion& motion,
               PlanarScan& out) {
  place_points(scanner, ranges, motion, out);
  // Kept from scan to scan so that none is allocated.
  thread_local std::vector<Sums> sums;
  sums.reserve(static_cast<std::size_t>(scanner.n) + 1);
  sums.assign(out.size() + 1, Sums{});
  for (std::size_t i = 0; i < out.size(); ++i) {
    sums[i + 1] = sums[i];
    sums[i + 1].add(out[i].p - out[0].p);
  }
  const double step = std::abs(scanner.increment());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Neighbors near = neighbors_of(out, ranges, i, step, scanner.noise);
    ScanPoint& point = out[i];
    Vector2d across = Vector2d::Zero();
    if (near.last - near.first < 2) {
      point.surroundings =
          stands_alone(out, ranges, near) ? Surroundings::kCorner : Surroundings::kSparse;
    } else if (fit_line(sums, near, i, scanner.noise, across)) {
      point.surroundings = Surroundings::kSurface;
      across *= across.dot(point.normal) > 0.0 ? -1.0 : 1.0;
    } else {
      point.surroundings = Surroundings::kCorner;
      across.setZero();
    }
    point.normal = across;
  }
}

}  // namespace thing_kin
