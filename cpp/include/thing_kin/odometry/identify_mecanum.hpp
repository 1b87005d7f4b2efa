#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "thing_kin/lie/se2.hpp"
#include "thing_kin/odometry/mecanum.hpp"
#include "thing_kin/odometry/planar_motion.hpp"

namespace thing_kin {

/// What is identified, in this order: log of the wheel radius, log of k, where the reference's
/// body is mounted on the robot (x, y in m, yaw in rad), clock offset in s.
inline constexpr int kMecanumParameters = 6;
using MecanumVector = Eigen::Matrix<double, kMecanumParameters, 1>;
using MecanumMatrix = Eigen::Matrix<double, kMecanumParameters, kMecanumParameters>;

/// What is known before, and how the record is cut.
struct MecanumIdentificationOptions {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double wheel_radius = kNone;    ///< nominal, m; none: some 0.1 m, within a factor of three
  double k = kNone;               ///< nominal, m; none: some 0.4 m, within a factor of two
  double wheel_radius_std = 0.2;  ///< of the nominal value, as a fraction of it
  double k_std = 0.2;             ///< the same
  Pose2 mount = Pose2::Zero();    ///< pose of the reference's body on the robot
  Eigen::Vector3d mount_std{0.1, 0.1, 3.0};  ///< m, m, rad; 0: exactly known
  double clock_offset_std = 0.0;             ///< of "wheel stamps are ahead by so much", s
  double window = 1.0;                       ///< of relative motions, s
  double longest_gap = 0.3;  ///< of the wheels' stamps, s: no motion across a longer one
};

enum class MecanumStatus : std::uint8_t { kConverged, kNotConverged, kTooLittleMotion };

/// One of the numbers identified.
struct MecanumParameter {
  std::string name;
  double value = 0.0;
  double std = 0.0;
  double nominal = 0.0;
  double nominal_std = 0.0;
  bool identifiable = false;
};

struct MecanumIdentification {
  MecanumStatus status = MecanumStatus::kTooLittleMotion;
  std::array<MecanumParameter, kMecanumParameters> parameters;
  MecanumMatrix covariance = MecanumMatrix::Zero();  ///< of the values, not of their logarithms
  Eigen::Vector3d slip_variance = Eigen::Vector3d::Zero();  ///< x, y, theta, for a metre of travel
  Eigen::Vector3d reference_std = Eigen::Vector3d::Zero();  ///< of a window's reference pose
  PlanarEstimate start;                                     ///< the robot in the first window
  double start_time = 0.0;
  /// Of the robot at the wheels' first stamp: as the reference saw its place, with the yaw that
  /// fits the whole run; and as place and yaw fit the whole run.
  Pose2 initial_pose = Pose2::Zero();
  Pose2 aligned_pose = Pose2::Zero();
  double rms_nominal = 0.0;    ///< from `start`, nominal parameters, m
  double rms_unaligned = 0.0;  ///< from initial_pose
  double rms_aligned = 0.0;    ///< from aligned_pose
  std::vector<double> times;   ///< of the windows
  std::vector<double> nees;    ///< of dead reckoning from the first to each
  double nees_inside = 0.0;    ///< fraction below the 95 % bound of chi-square, 3 degrees
  int windows = 0;             ///< relative motions that were used
  int outliers = 0;            ///< of these, those that were weighed down
  int iterations = 0;
};

/// Wheel radius, k and mount from a record with reference poses. Rows of `angles` are
/// (fl, rl, rr, fr) in rad, whole turns included; stamps do not decrease. Throws InvalidArgument.
///
/// Successive errors of odometry add up, so that relative motions between windows are weighed,
/// never absolute poses: the pose of a window is the median of its reference poses, each carried to
/// the window's middle by the wheels; its error is shared by the motions before and after it, and
/// the wheels add the error of a random walk with a variance for each metre, estimated from the
/// record. Gauss-Newton on SE(2) with exact derivatives, outlying windows weighed down (Cauchy).
MecanumIdentification identify_mecanum(std::span<const double> t,
                                       std::span<const Eigen::Vector4d> angles,
                                       std::span<const double> t_reference,
                                       std::span<const Pose2> poses,
                                       const MecanumIdentificationOptions& options = {});

}  // namespace thing_kin
