#pragma once

#include "thing_kin/core/types.hpp"
#include "thing_kin/lie/se3.hpp"
#include "thing_kin/model/chain.hpp"

namespace thing_kin {

/// Where every joint is at one q: what forward kinematics, Jacobian and Hessian read.
struct Posture {
  /// Moved frame of each joint, from the root outwards: columns x, y, z, origin, each padded to
  /// four numbers. z is the joint's axis, the origin lies on it; how far x is turned about z is the
  /// skeleton's business (model/skeleton.hpp).
  alignas(64) double columns[16 * kMaxDof];
};

/// Fills a posture, [M17] (3.8). q has chain.dof() finite entries.
void place_joints(const Chain& chain, const double* q, Posture& posture) noexcept;

/// Pose of a frame (an index into chain.frames()) in the root.
SE3 frame_pose(const Chain& chain, const Posture& posture, int frame) noexcept;

/// Pose of one frame at q without keeping the posture.
SE3 forward_kinematics(const Chain& chain, const double* q, int frame) noexcept;

}  // namespace thing_kin
