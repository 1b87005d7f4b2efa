#include "thing_kin/kinematics/pose_error.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "thing_kin/core/error.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin {

ErrorMethod error_method_from_string(const std::string& name) {
  if (name == "log") {
    return ErrorMethod::kLog;
  }
  if (name == "cross") {
    return ErrorMethod::kCross;
  }
  throw InvalidArgument("method", quoted(name), "'log' or 'cross'");
}

ErrorFrame error_frame_from_string(const std::string& name) {
  if (name == "world_aligned") {
    return ErrorFrame::kWorldAligned;
  }
  if (name == "body") {
    return ErrorFrame::kBody;
  }
  throw InvalidArgument("frame", quoted(name), "'world_aligned' or 'body'");
}

Vector6 pose_error(const SE3& T, const SE3& T_goal) noexcept {
  Vector6 error;
  error << T_goal.translation - T.translation, so3_log(T_goal.rotation * T.rotation.transpose());
  return error;
}

Vector6 pose_error_body(const SE3& T, const SE3& T_goal) noexcept {
  return se3_log(T.inverse() * T_goal);
}

Eigen::Vector3d orientation_error_cross(const Eigen::Matrix3d& R,
                                        const Eigen::Matrix3d& R_goal) noexcept {
  Eigen::Vector3d e = Eigen::Vector3d::Zero();
  Eigen::Matrix3d L = Eigen::Matrix3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    e += 0.5 * R.col(axis).cross(R_goal.col(axis));
    L -= 0.5 * skew(R.col(axis)) * skew(R_goal.col(axis));
  }
  return L.inverse() * e;
}

double rotation_angle(const Eigen::Matrix3d& R, const Eigen::Matrix3d& R_goal) noexcept {
  return so3_log(R_goal * R.transpose()).norm();
}

}  // namespace thing_kin
