#pragma once

#include "thing_kin/kinematics/posture.hpp"

namespace thing_kin {

using TaskVector = Eigen::Matrix<double, 10, 1>;

/// (x, y, theta) of the base, read from q, [M17] (3.4). The chain must have a base.
Eigen::Vector3d base_pose(const Chain& chain, const double* q) noexcept;

/// s = [p (3), quaternion w x y z (4), x, y, theta], [M17] (3.3)-(3.5). The chain must have a base.
TaskVector task_vector(const Chain& chain, const double* q) noexcept;

}  // namespace thing_kin
