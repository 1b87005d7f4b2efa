#pragma once

#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/kinematics/task_vector.hpp"

namespace thing_kin {

/// Derivative of at most ten coordinates, (m, n).
using AnalyticJacobian =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 10, kMaxDof>;

/// d[p, orientation]/dq of a point and its frame, (7, n) or (6, n): [M17] (3.9) of (3.3); with kRpy
/// not in the theses. The quaternion's is that of the branch that quaternion_from_rotation takes
/// (w >= 0).
///
/// False, and J is left alone, with kRpy at a pitch within kQuarterTurnMargin of +-pi/2, where roll
/// and yaw have no rates.
[[nodiscard]] bool analytic_jacobian(const Chain& chain, const Posture& posture,
                                     const MovingPoint& of, Orientation orientation,
                                     AnalyticJacobian& J) noexcept;

/// ds/dq of the task vector, (10, n) or (9, n), [M17] (3.9) of (3.5); false as above. The chain
/// must have a base.
[[nodiscard]] bool task_jacobian(const Chain& chain, const Posture& posture,
                                 Orientation orientation, AnalyticJacobian& J) noexcept;

}  // namespace thing_kin
