#pragma once

#include <cstdint>
#include <string>

#include "thing_kin/core/types.hpp"
#include "thing_kin/lie/se3.hpp"

namespace thing_kin {

/// How an orientation difference becomes three numbers.
enum class ErrorMethod : std::uint8_t {
  kLog,    ///< rotation vector, [M17] (4.28): valid up to pi
  kCross,  ///< [M17] (3.18): tan(angle) axis, valid below pi/2 only
};

/// The axes of a pose error.
enum class ErrorFrame : std::uint8_t {
  kWorldAligned,  ///< [p_goal - p; log(R_goal R^T)], axes of the world
  kBody,          ///< log(T^-1 T_goal) on SE(3), [M17] (4.28) with its sign corrected
};

ErrorMethod error_method_from_string(const std::string& name);
ErrorFrame error_frame_from_string(const std::string& name);

/// [p_goal - p; log(R_goal R^T)]: J dq ~ pose_error(fk(q), fk(q + dq)) with the default Jacobian.
Vector6 pose_error(const SE3& T, const SE3& T_goal) noexcept;

/// log(T^-1 T_goal).
Vector6 pose_error_body(const SE3& T, const SE3& T_goal) noexcept;

/// Orientation part of (3.18), axes of the world: tan(angle) axis. Its domain is angle < pi/2.
Eigen::Vector3d orientation_error_cross(const Eigen::Matrix3d& R,
                                        const Eigen::Matrix3d& R_goal) noexcept;

/// Angle of the rotation from R to R_goal, [0, pi].
double rotation_angle(const Eigen::Matrix3d& R, const Eigen::Matrix3d& R_goal) noexcept;

}  // namespace thing_kin
