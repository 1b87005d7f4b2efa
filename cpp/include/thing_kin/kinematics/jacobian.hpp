#pragma once

#include <cstdint>
#include <string>

#include "thing_kin/kinematics/posture.hpp"

namespace thing_kin {

/// What a Jacobian's rows mean, [linear; angular].
enum class ReferenceFrame : std::uint8_t {
  kWorldAligned,  ///< velocity of the frame's origin, axes of the root
  kBody,          ///< velocity of the frame's origin, axes of the frame
  kWorld,  ///< spatial twist: velocity of the point now at the root's origin, axes of the root
};

ReferenceFrame reference_frame_from_string(const std::string& name);

/// Geometric Jacobian of a frame, [M17] (3.12)-(3.15) and Algorithm 1 as corrected.
void geometric_jacobian(const Chain& chain, const Posture& posture, int frame,
                        ReferenceFrame reference, Jacobian& J) noexcept;

}  // namespace thing_kin
