#include "thing_kin/odometry/identify_mecanum.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "mecanum_fit.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

constexpr int kMostIterations = 60;
constexpr int kNoiseIterations = 12;     // after these the noise is taken as known
constexpr int kMedianIterations = 4;     // before these, outliers are not known
constexpr double kConvergedStep = 1e-5;  // of a standard deviation
// Where poses at the ends of the records come and go, steps stay larger, but this does not matter.
constexpr double kSmallStep = 1e-2;
// A record that leaves more than this of the prior's standard deviation has not shown the value.
constexpr double kShown = 0.5;
constexpr double kTurned = 0.5;    // rad: less is no turning
constexpr double kLeastRun = 0.1;  // m, of the rims
constexpr std::size_t kLeastMotions = 4;
constexpr double kChiSquare95 = 7.8147;  // 3 degrees of freedom

// How far the reference turns in all, as the range of its heading.
double range_of_heading(const std::vector<ReferenceWindow>& windows) {
  double heading = 0.0;
  double least = 0.0;
  double most = 0.0;
  for (std::size_t i = 0; i + 1 < windows.size(); ++i) {
    heading += wrap_angle(windows[i + 1].pose.z() - windows[i].pose.z());
    least = std::min(least, heading);
    most = std::max(most, heading);
  }
  return most - least;
}

// Of a robot that only trembles neither k nor the place of the mount can be known, though the
// trembling of a tracker, or of encoder ticks, may look like it.
void hold_what_needs_turning(MecanumFit& fit) {
  if (range_of_heading(fit.windows()) < kTurned) {
    fit.held[1] = fit.held[2] = fit.held[3] = true;
  }
}

bool descend(MecanumFit& fit, int& iterations) {
  double moved = 0.0;
  for (int i = 0; i < kMostIterations; ++i, ++iterations) {
    fit.linearize();
    if (i < kNoiseIterations) {
      fit.estimate_noise(i >= kMedianIterations);
      fit.weigh();
      fit.rescale();
    }
    moved = fit.step();
    if (!std::isfinite(moved)) {
      return false;
    }
    if (moved < kConvergedStep && i >= kMedianIterations) {
      break;
    }
  }
  fit.linearize();
  return moved < kSmallStep;
}

// Holds what the record has not shown at its prior; false if there is nothing of the kind.
bool hold_unshown(MecanumFit& fit) {
  const MecanumMatrix P = fit.covariance();
  bool any = false;
  for (int i = 0; i < kMecanumParameters; ++i) {
    bool& held = fit.held[static_cast<std::size_t>(i)];
    if (!held && !(std::sqrt(P(i, i)) < kShown * fit.prior_std[i])) {
      held = true;
      fit.x[i] = fit.prior[i];
      any = true;
    }
  }
  return any;
}

void report_parameters(const MecanumFit& fit, MecanumIdentification& result) {
  constexpr std::array<const char*, kMecanumParameters> kNames{
      "wheel_radius", "k", "mount_x", "mount_y", "mount_yaw", "clock_offset"};
  const MecanumMatrix P = fit.covariance();
  MecanumVector slope = MecanumVector::Ones();
  slope.head<2>() = fit.x.head<2>().array().exp();
  result.covariance = slope.asDiagonal() * P * slope.asDiagonal();
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    MecanumParameter& parameter = result.parameters[i];
    const double nominal = j < 2 ? std::exp(fit.prior[j]) : fit.prior[j];
    parameter.name = kNames[i];
    parameter.value = j < 2 ? std::exp(fit.x[j]) : fit.x[j];
    parameter.std = std::sqrt(result.covariance(j, j));
    parameter.nominal = nominal;
    parameter.nominal_std = fit.prior_std[j] * (j < 2 ? nominal : 1.0);
    parameter.identifiable = !fit.held[i];
  }
}

// The robot in the first window: the reference's pose less the mount.
void report_start(const MecanumFit& fit, MecanumIdentification& result) {
  const ReferenceWindow& first = fit.windows().front();
  const Pose2 mount = fit.mount();
  result.start_time = first.t;
  result.start.pose = compose(first.pose, inverse(mount));
  const double c = std::cos(result.start.pose.z());
  const double s = std::sin(result.start.pose.z());
  // Position = that of the reference - Rot(theta) mount; theta = that of the reference - yaw.
  Eigen::Matrix3d by_mount;
  const Eigen::Vector2d turned(s * mount.x() + c * mount.y(), -c * mount.x() + s * mount.y());
  by_mount << -c, s, -turned.x(), -s, -c, -turned.y(), 0.0, 0.0, -1.0;
  Eigen::Matrix3d by_reference = Eigen::Matrix3d::Identity();
  by_reference.topRightCorner<2, 1>() = turned;
  const Eigen::Vector3d variance = first.variance + fit.noise.reference;
  result.start.covariance = by_reference * variance.asDiagonal() * by_reference.transpose() +
                            by_mount * result.covariance.block<3, 3>(2, 2) * by_mount.transpose();
}

// Where the reference's body was in each window, by dead reckoning from zero, and by itself.
struct Paths {
  std::vector<Pose2> robot;
  std::vector<Eigen::Vector2d> seen;
};

Paths paths_of(const MecanumFit& fit, const WheelPath& wheels) {
  Paths paths;
  const Pose2 first = wheels.pose_at(fit.windows().front().t);
  for (const ReferenceWindow& window : fit.windows()) {
    paths.robot.push_back(between(first, wheels.pose_at(window.t)));
    paths.seen.emplace_back(window.pose.head<2>());
  }
  return paths;
}

double rms_from(const Pose2& start, const Pose2& mount, const Paths& paths) {
  double sum = 0.0;
  for (std::size_t i = 0; i < paths.robot.size(); ++i) {
    const Pose2 body = compose(compose(start, paths.robot[i]), mount);
    sum += (body.head<2>() - paths.seen[i]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(paths.robot.size()));
}

// The pose at the start that fits the whole run: least squares (Procrustes), about the means or, if
// `pinned`, about the first window.
Pose2 fitted_start(const Pose2& mount, const Paths& paths, bool pinned) {
  Eigen::Vector2d ours = compose(paths.robot.front(), mount).head<2>();
  Eigen::Vector2d theirs = paths.seen.front();
  const auto count = static_cast<double>(paths.robot.size());
  if (!pinned) {
    ours.setZero();
    theirs.setZero();
    for (std::size_t i = 0; i < paths.robot.size(); ++i) {
      ours += compose(paths.robot[i], mount).head<2>() / count;
      theirs += paths.seen[i] / count;
    }
  }
  double cosine = 0.0;
  double sine = 0.0;
  for (std::size_t i = 0; i < paths.robot.size(); ++i) {
    const Eigen::Vector2d a = compose(paths.robot[i], mount).head<2>() - ours;
    const Eigen::Vector2d b = paths.seen[i] - theirs;
    cosine += a.dot(b);
    sine += a.x() * b.y() - a.y() * b.x();
  }
  Pose2 start(0.0, 0.0, std::atan2(sine, cosine));
  Pose2 moved;
  moved << ours, 0.0;
  start.head<2>() = theirs - compose(start, moved).head<2>();
  return start;
}

void report_paths(const MecanumFit& fit, MecanumIdentification& result) {
  const Pose2 mount = fit.mount();
  const Paths paths = paths_of(fit, fit.wheels());
  result.initial_pose = fitted_start(mount, paths, true);
  result.aligned_pose = fitted_start(mount, paths, false);
  result.rms_unaligned = rms_from(result.initial_pose, mount, paths);
  result.rms_aligned = rms_from(result.aligned_pose, mount, paths);
  // From the first window back to the wheels' first stamp.
  const Pose2 back = inverse(fit.wheels().pose_at(fit.windows().front().t));
  result.initial_pose = compose(result.initial_pose, back);
  result.aligned_pose = compose(result.aligned_pose, back);
  WheelPath nominal = fit.wheels();
  nominal.set(std::exp(fit.prior[0]), std::exp(fit.prior[1]), fit.prior[5]);
  const Pose2 nominal_mount = fit.prior.segment<3>(2);
  const Pose2 seen = compose(fit.windows().front().pose, inverse(nominal_mount));
  result.rms_nominal = rms_from(seen, nominal_mount, paths_of(fit, nominal));
}

void report_nees(const MecanumFit& fit, MecanumIdentification& result) {
  const MecanumMatrix P = fit.covariance();
  const std::vector<RelativeMotion> motions = fit.from_start();
  std::size_t inside = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Eigen::Matrix3d S =
        fit.covariance_of(motions[i], 0, i + 1) + motions[i].J * P * motions[i].J.transpose();
    const double nees = motions[i].error.dot(S.llt().solve(motions[i].error));
    result.times.push_back(fit.windows()[i + 1].t);
    result.nees.push_back(nees);
    inside += nees < kChiSquare95 ? 1 : 0;
  }
  result.nees_inside = static_cast<double>(inside) / static_cast<double>(motions.size());
}

void report_noise(const MecanumFit& fit, MecanumIdentification& result) {
  std::vector<double> own;
  for (Eigen::Index c = 0; c < 3; ++c) {
    own.clear();
    for (const ReferenceWindow& window : fit.windows()) {
      own.push_back(window.variance[c]);
    }
    result.reference_std[c] = std::sqrt(median_of(own) + fit.noise.reference[c]);
  }
  result.slip_variance = fit.noise.slip;
  result.windows = static_cast<int>(fit.used());
  result.outliers = static_cast<int>(
      std::ranges::count_if(fit.weights(), [](double w) { return w > 0.0 && w < 1.0; }));
}

void report(MecanumFit& fit, MecanumIdentification& result) {
  fit.linearize();
  report_parameters(fit, result);
  report_start(fit, result);
  report_paths(fit, result);
  report_nees(fit, result);
  report_noise(fit, result);
}

void check_stamps(std::span<const double> t, std::size_t rows, const char* name,
                  const char* rows_name) {
  if (t.size() != rows) {
    throw InvalidArgument(rows_name, std::to_string(rows) + " rows",
                          "one for each of the " + std::to_string(t.size()) + " stamps");
  }
  if (t.size() < 2) {
    throw InvalidArgument(name, std::to_string(t.size()) + " stamps", "at least two");
  }
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    if (!(t[i + 1] >= t[i])) {
      throw InvalidArgument(name, "a stamp before the last one, at index " + std::to_string(i + 1),
                            "stamps that do not decrease");
    }
  }
  if (!(t.back() > t.front())) {
    throw InvalidArgument(name, "stamps that are all equal", "a record that lasts");
  }
}

void check_positive(double value, const char* name, bool optional) {
  if (!(optional && std::isnan(value)) && !(std::isfinite(value) && value > 0.0)) {
    throw InvalidArgument(name, text(value), "a finite number > 0");
  }
}

void check_options(const MecanumIdentificationOptions& options) {
  check_positive(options.wheel_radius, "wheel_radius", true);
  check_positive(options.k, "k", true);
  check_positive(options.window, "window", false);
  check_positive(options.longest_gap, "longest_gap", false);
  const auto spread = [](double value, const char* name) {
    if (!(std::isfinite(value) && value >= 0.0)) {
      throw InvalidArgument(name, text(value), "a finite number >= 0");
    }
  };
  spread(options.wheel_radius_std, "wheel_radius_std");
  spread(options.k_std, "k_std");
  spread(options.clock_offset_std, "clock_offset_std");
  for (int i = 0; i < 3; ++i) {
    spread(options.mount_std[i], "mount_std");
  }
}

}  // namespace

MecanumIdentification identify_mecanum(std::span<const double> t,
                                       std::span<const Eigen::Vector4d> angles,
                                       std::span<const double> t_reference,
                                       std::span<const Pose2> poses,
                                       const MecanumIdentificationOptions& options) {
  check_stamps(t, angles.size(), "t", "wheel_angles");
  check_stamps(t_reference, poses.size(), "t_reference", "poses");
  check_options(options);
  if (t_reference.front() > t.back() || t_reference.back() < t.front()) {
    throw InvalidArgument("t_reference", "stamps that share no time with t",
                          "two records of one time");
  }
  MecanumFit fit({t_reference, poses}, WheelPath(t, angles, options.longest_gap), options);
  MecanumIdentification result;
  fit.linearize();
  if (fit.windows().empty()) {
    throw InvalidArgument("t_reference", "no reference pose while the wheels were read",
                          "two records of one time");
  }
  if (fit.used() < kLeastMotions || fit.travel() < kLeastRun) {
    fit.held.fill(true);
    report(fit, result);
    return result;
  }
  hold_what_needs_turning(fit);
  fit.guess();
  bool converged = descend(fit, result.iterations);
  for (int i = 0; i < kMecanumParameters && converged && hold_unshown(fit); ++i) {
    converged = descend(fit, result.iterations);
  }
  result.status = converged ? MecanumStatus::kConverged : MecanumStatus::kNotConverged;
  // Nothing is known but the prior; a clock offset may have left the record.
  if (fit.windows().empty() || !fit.x.allFinite() || !fit.covariance().allFinite()) {
    fit.x = fit.prior;
    fit.held.fill(true);
    result.status = MecanumStatus::kNotConverged;
  }
  report(fit, result);
  return result;
}

}  // namespace thing_kin
