#include "thing_kin/odometry/laser_odometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// What a robot's velocity may change by while nothing measures it: deviations grow with the time
// between scans, to so much at most. m, m/s; rad, rad/s.
constexpr double kGuessOffset = 0.02;
constexpr double kGuessRate = 2.0;
constexpr double kGuessMost = 0.2;
constexpr double kTurnMost = 1.0;
constexpr double kTurnOffset = 0.05;
constexpr double kTurnRate = 4.0;
// Velocities change towards zero, on the mean.
constexpr double kPersistence = 0.9;
// s: so long a velocity is held, or twice the time between the scans that showed it.
constexpr double kHold = 0.5;
// A velocity that was assumed, not measured, costs a fit no more fitness than this.
constexpr double kMostPenalty = 0.5;
// A pose that was held moves if it is off by more than this quantile (chi square, 3 dof, 95 %).
constexpr double kStillBound = 7.815;
// Starts closer than this, in m and rad, lead to the same fit.
constexpr double kSameStart = 0.04;
// Less of a scan's points on the map than this: it shows what the map doesn't know.
constexpr double kWellKnown = 0.7;
// Sine of the angle between two estimates of one direction that scans leave open, at most.
constexpr double kSameDirection = 0.1;
// Of a scan that moved, in m or rad: once more if the guess of its own motion was worse.
constexpr double kSkew = 1e-3;

void check_option(double value, const char* name, bool zero_allowed) {
  if (!(std::isfinite(value) && (value > 0.0 || (zero_allowed && value == 0.0)))) {
    throw InvalidArgument(name, text(value), zero_allowed ? "a number >= 0" : "a number > 0");
  }
}

// Covariance of T_a_b, in the axes of a, for poses with independent errors (world axes).
Matrix3d motion_covariance(const Pose2& a, const Matrix3d& P_a, const Pose2& b,
                           const Matrix3d& P_b) {
  Matrix3d to_a = Matrix3d::Identity();
  to_a.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(-a.z()).toRotationMatrix();
  Matrix3d by_a = -to_a;
  const Pose2 motion = between(a, b);
  by_a(0, 2) = motion.y();
  by_a(1, 2) = -motion.x();
  const Matrix3d sum = by_a * P_a * by_a.transpose() + to_a * P_b * to_a.transpose();
  return 0.5 * (sum + sum.transpose());
}

// Directions that a match leaves open, as columns (x, y, theta), world axes.
Matrix3d untold_of(const ScanMatch& match) {
  const Vector3d unit(1.0, 1.0, 1.0 / match.arm);
  return unit.asDiagonal() * match.untold;
}

// Of directions that were open before those that are not still open now. Two estimates of one
// corridor's direction differ by milliradians, of 100 m, which would blur what is told across it.
// A heading that was open turns the motion, whatever is known now.
Matrix3d no_longer_open(const Matrix3d& before, const ScanMatch& now) {
  Matrix3d out = Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vector3d v = Vector3d(1.0, 1.0, now.arm).cwiseProduct(before.col(k)).normalized();
    const Vector3d rest = v - now.untold * (now.untold.transpose() * v);
    if (rest.norm() > kSameDirection || std::abs(v.z()) > kSameDirection) {
      out.col(k) = before.col(k);
    }
  }
  return out;
}

// A covariance in the axes of `from`, in world axes.
Matrix3d in_world(const Pose2& from, const Matrix3d& P) {
  Matrix3d R = Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(from.z()).toRotationMatrix();
  return R * P * R.transpose();
}

}  // namespace

LaserOdometry::LaserOdometry(const Scanner& scanner, const LaserOdometryOptions& options)
    : scanner_(scanner), options_(options) {
  check_scanner(scanner);
  check_option(options.keyframe_distance, "keyframe_distance", true);
  check_option(options.keyframe_angle, "keyframe_angle", true);
  check_option(options.memory, "memory", false);
  check_option(options.radius, "radius", false);
  check_option(options.still_distance, "still_distance", true);
  check_option(options.still_angle, "still_angle", true);
  check_match_options(options.match);
  if (options.lost_limit < 1) {
    throw InvalidArgument("lost_limit", std::to_string(options.lost_limit), "a number >= 1");
  }
}

PlanarEstimate LaserOdometry::guess_motion(double dt,
                                           const std::optional<PlanarEstimate>& motion) const {
  if (motion) {
    return *motion;
  }
  const double sd = std::min(kGuessOffset + kGuessRate * dt, kGuessMost);
  const double turn = std::min(kTurnOffset + kTurnRate * dt, kTurnMost);
  // Over a gap a velocity says little.
  return {.pose = se2_exp(kPersistence * twist_ * std::min(dt, std::max(kHold, 2.0 * dt_))),
          .covariance = Vector3d(sd * sd, sd * sd, turn * turn).asDiagonal()};
}

ScanMatch LaserOdometry::match(const MatchGuess& guess, bool guided) const {
  // Without wheels the robot may also have stopped, which is no other start if it hardly moved.
  const std::array<Pose2, 1> standing{pose_};
  const bool apart = !guided && (guess.pose - pose_).cwiseAbs().maxCoeff() > kSameStart;
  return match_scan(map_, scan_, guess,
                    apart ? std::span<const Pose2>{standing} : std::span<const Pose2>{},
                    scanner_.noise, options_.match);
}

bool LaserOdometry::seems_still(const ScanMatch& match) const {
  const Vector3d off = pose_difference(match.pose, pose_);
  return match.degenerate == 0 && off.head<2>().norm() <= options_.still_distance &&
         std::abs(off.z()) <= options_.still_angle &&
         off.dot((match.covariance + noise_).llt().solve(off)) <= kStillBound;
}

// The scan goes into the map if the robot has moved, or sees what the map doesn't know.
void LaserOdometry::keep(LaserStep& step) {
  const Pose2 moved = between(keyframe_, pose_);
  step.keyframe = moved.head<2>().norm() > options_.keyframe_distance ||
                  std::abs(moved.z()) > options_.keyframe_angle ||
                  (step.status == LaserStatus::kTracking && step.match.inliers < kWellKnown);
  if (step.keyframe) {
    keyframe_ = pose_;
    map_.insert(scan_, pose_, way_);
    map_.forget(pose_.head<2>(), options_.radius, way_ - options_.memory);
  }
}

// Where the robot may be, in the map, after a motion that was measured or is guessed.
MatchGuess LaserOdometry::guess_pose(const PlanarEstimate& moved, bool measured) const {
  const Pose2 guessed = compose(pose_, moved.pose);
  Matrix3d by_pose = Matrix3d::Identity();
  by_pose(0, 2) = -(guessed - pose_).y();
  by_pose(1, 2) = (guessed - pose_).x();
  return {.pose = guessed,
          .covariance = by_pose * noise_ * by_pose.transpose() + in_world(pose_, moved.covariance),
          .most_penalty = measured ? std::numeric_limits<double>::infinity() : kMostPenalty};
}

ScanMatch LaserOdometry::find(std::span<const double> ranges, const MatchGuess& guess,
                              const Twist2& twist, double dt) {
  const bool measured = std::isinf(guess.most_penalty);
  ScanMatch first = match(guess, measured);
  const Twist2 seen = se2_log(between(pose_, first.pose)) / dt;
  const double skew = ((seen - twist) * scanner_.scan_time).cwiseAbs().maxCoeff();
  if (skew <= kSkew || first.status != MatchStatus::kConverged) {
    return first;
  }
  // The robot moved otherwise than the scan was corrected for.
  read_scan(scanner_, ranges, seen, scan_);
  MatchGuess better = guess;
  better.pose = first.pose;
  return match(better, true);
}

// The scan begins a map: nothing was seen so far, or all was forgotten.
void LaserOdometry::begin(const PlanarEstimate& moved, LaserStep& step) {
  pose_ = compose(pose_, moved.pose);
  map_.insert(scan_, pose_, way_);
  step.status = map_.surfels().empty() ? LaserStatus::kLost : LaserStatus::kFirst;
  step.keyframe = step.status == LaserStatus::kFirst;
  step.motion = moved.pose;
  step.covariance = moved.covariance;
  step.scan_covariance = Matrix3d::Identity() * kUntoldVariance;
  keyframe_ = pose_;
  noise_.setZero();
  untold_.setZero();
}

// Along what no scan tells the motion is as uncertain as its guess, or of no use; the pose, in the
// map, as all guesses since something told.
void LaserOdometry::spread(const Pose2& before, const PlanarEstimate& moved, LaserStep& step) {
  const ScanMatch& match = step.match;
  const Matrix3d untold = Matrix3d::Identity() - match.told;
  const Matrix3d guessed = untold * in_world(before, moved.covariance) * untold.transpose();
  const Matrix3d P_before = match.told * noise_ * match.told.transpose();
  const Matrix3d P_now = match.told * match.covariance * match.told.transpose();
  step.covariance = motion_covariance(before, P_before, pose_, P_now + guessed);
  const Matrix3d open_before = no_longer_open(untold_, match);
  const Matrix3d open_now = untold_of(match);
  step.scan_covariance =
      motion_covariance(before, P_before + kUntoldVariance * open_before * open_before.transpose(),
                        pose_, P_now + kUntoldVariance * open_now * open_now.transpose());
  noise_ = match.covariance;
  untold_ = open_now;
}

// Goes where the match says, or on with its guess.
void LaserOdometry::follow(const ScanMatch& match, const PlanarEstimate& moved, LaserStep& step) {
  const bool found =
      match.status == MatchStatus::kConverged || match.status == MatchStatus::kIterationLimit;
  step.match = match;
  step.status = !found               ? LaserStatus::kLost
                : seems_still(match) ? LaserStatus::kStill
                                     : LaserStatus::kTracking;
  const Pose2 before = pose_;
  pose_ = step.status == LaserStatus::kStill ? pose_ : match.pose;
  step.motion = between(before, pose_);
  spread(before, moved, step);
  if (found) {
    // What the scans hardly tell must not become a velocity: weighed with the guess.
    const Pose2 off = pose_difference(step.motion, moved.pose);
    const Matrix3d sum = step.covariance + moved.covariance;
    const Pose2 likely = moved.pose + moved.covariance * sum.ldlt().solve(off);
    twist_ = se2_log(likely) / (step.t - step.t_from);
  }
}

// A map begins anew where too many scans in a row are lost.
void LaserOdometry::count_lost(LaserStep& step) {
  if (++lost_ < options_.lost_limit || scan_.empty()) {
    return;
  }
  lost_ = 0;
  map_.clear();
  map_.insert(scan_, pose_, way_);
  keyframe_ = pose_;
  noise_.setZero();
  untold_.setZero();
  step.keyframe = true;
}

LaserStep LaserOdometry::add(std::span<const double> ranges, double t,
                             const std::optional<PlanarEstimate>& motion,
                             const std::optional<ScanMotion>& during) {
  if (!std::isfinite(t) || (t_ && !(t > *t_))) {
    throw InvalidArgument("t", text(t), t_ ? "a time after " + text(*t_) : "a finite time");
  }
  LaserStep step;
  step.t = t;
  step.t_from = t_.value_or(t);
  const double dt = t - step.t_from;
  const PlanarEstimate moved = t_ ? guess_motion(dt, motion) : PlanarEstimate{};
  const Twist2 twist = dt > 0.0 ? Twist2(se2_log(moved.pose) / dt) : Twist2::Zero();
  read_scan(scanner_, ranges, during.value_or(ScanMotion{.first = twist, .last = twist}), scan_);
  if (map_.surfels().empty()) {
    begin(moved, step);
  } else {
    const MatchGuess guess = guess_pose(moved, motion.has_value());
    follow(during ? match(guess, motion.has_value()) : find(ranges, guess, twist, dt), moved, step);
  }
  t_ = t;
  dt_ = dt;
  way_ += step.motion.head<2>().norm();
  step.pose = pose_;
  if (step.status == LaserStatus::kLost) {
    count_lost(step);
    return step;
  }
  lost_ = 0;
  if (step.status != LaserStatus::kFirst) {
    keep(step);
  }
  return step;
}

}  // namespace thing_kin
