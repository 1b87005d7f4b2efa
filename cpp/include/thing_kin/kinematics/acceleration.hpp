#pragma once

#include <cstdint>
#include <string>

#include "thing_kin/kinematics/jacobian.hpp"

namespace thing_kin {

// Velocity, acceleration and what of it the joints' velocities alone cause; none is in the theses.
// Vectors are [linear; angular] as in `reference`; qd and qdd have chain.dof() entries, rad/s and
// m/s, rad/s^2 and m/s^2.

/// What the linear part of an acceleration means. With the velocity [v; w] in the same frame,
/// classical = spatial + w x v.
enum class AccelerationKind : std::uint8_t {
  kClassical,  ///< second derivative of the point's position
  kSpatial,    ///< derivative of the twist, as rigid-body dynamics takes it (Featherstone 2008)
};

AccelerationKind acceleration_kind_from_string(const std::string& name);

/// J qd.
Vector6 frame_velocity(const Chain& chain, const Posture& posture, const MovingPoint& of,
                       ReferenceFrame reference, const double* qd) noexcept;

/// dJ/dt qd in O(n), without dJ/dt: what J qdd lacks to be the derivative of J qd.
Vector6 frame_drift(const Chain& chain, const Posture& posture, const MovingPoint& of,
                    ReferenceFrame reference, const double* qd) noexcept;

/// Of the point, in any reference frame. The derivative of J qd, J qdd + dJ/dt qd, is the classical
/// one in kWorldAligned and the spatial one in kBody and kWorld.
Vector6 frame_acceleration(const Chain& chain, const Posture& posture, const MovingPoint& of,
                           ReferenceFrame reference, AccelerationKind kind, const double* qd,
                           const double* qdd) noexcept;

}  // namespace thing_kin
