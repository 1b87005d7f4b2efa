#pragma once

#include <cstdint>
#include <string>

#include "thing_kin/kinematics/posture.hpp"

namespace thing_kin {

/// How an orientation becomes numbers.
enum class Orientation : std::uint8_t {
  kQuaternion,  ///< w x y z with w >= 0, [M17] (3.3)
  kRpy,         ///< roll, pitch, yaw of rotation_from_rpy; not in the theses
};

Orientation orientation_from_string(const std::string& name);

/// 4 or 3.
inline Eigen::Index size_of(Orientation orientation) {
  return orientation == Orientation::kQuaternion ? 4 : 3;
}

/// [p (3), orientation (4 or 3), x, y, theta].
using TaskVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 10, 1>;

/// (x, y, theta) of the base, read from q, [M17] (3.4). The chain must have a base.
Eigen::Vector3d base_pose(const Chain& chain, const double* q) noexcept;

/// s = [p, quaternion w x y z, x, y, theta], [M17] (3.3)-(3.5), or with roll, pitch and yaw in
/// place of the quaternion. The chain must have a base.
TaskVector task_vector(const Chain& chain, const double* q,
                       Orientation orientation = Orientation::kQuaternion) noexcept;

}  // namespace thing_kin
