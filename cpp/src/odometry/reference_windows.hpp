#pragma once

#include <span>
#include <vector>

#include "thing_kin/odometry/identify_mecanum.hpp"
#include "thing_kin/odometry/wheel_path.hpp"

namespace thing_kin {

/// The reference in one window of time: where its body was in the middle.
struct ReferenceWindow {
  double t = 0.0;
  Pose2 pose = Pose2::Zero();
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();  ///< of the pose, from the window's scatter
};

/// What a reference measured between two windows, less what the wheels say.
struct RelativeMotion {
  Eigen::Vector3d error = Eigen::Vector3d::Zero();    ///< log(wheels^-1 reference)
  Eigen::Matrix<double, 3, kMecanumParameters> J;     ///< of the error by the parameters
  Eigen::Matrix3d wheels = Eigen::Matrix3d::Zero();   ///< covariance that the wheels add
  Eigen::Matrix3d by_from = Eigen::Matrix3d::Zero();  ///< of the error by the windows' poses
  Eigen::Matrix3d by_to = Eigen::Matrix3d::Zero();
  double travel = 0.0;
  bool whole = true;
};

struct ReferenceRecord {
  std::span<const double> t;
  std::span<const Pose2> poses;
};

/// Cuts the time that both records cover; windows that hold no reference pose are left out.
std::vector<ReferenceWindow> cut_windows(const ReferenceRecord& reference, const WheelPath& wheels,
                                         const Pose2& mount, double duration);

/// `rolled`: what the wheels say between the two.
RelativeMotion relative_motion(const ReferenceWindow& from, const ReferenceWindow& to,
                               const WheelMotion& rolled, const Pose2& mount);

/// The middle one; of an even number the upper. Reorders.
double median_of(std::vector<double>& numbers);

}  // namespace thing_kin
