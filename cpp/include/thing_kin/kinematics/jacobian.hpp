#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "thing_kin/kinematics/posture.hpp"

namespace thing_kin {

/// What a Jacobian's rows mean, [linear; angular].
enum class ReferenceFrame : std::uint8_t {
  kWorldAligned,  ///< velocity of the point, axes of the root
  kBody,          ///< velocity of the point, axes of the frame
  kWorld,  ///< spatial twist: velocity of the point now at the root's origin, axes of the root
};

ReferenceFrame reference_frame_from_string(const std::string& name);

/// What moves: a point fixed to a frame. A frame's index alone means its origin.
struct MovingPoint {
  int frame;
  Eigen::Vector3d point;  ///< coordinates in that frame, m

  MovingPoint(int frame_index, Eigen::Vector3d at = Eigen::Vector3d::Zero()) noexcept
      : frame(frame_index), point(std::move(at)) {}
};

/// Geometric Jacobian of a point, [M17] (3.12)-(3.15) and Algorithm 1 as corrected.
void geometric_jacobian(const Chain& chain, const Posture& posture, const MovingPoint& of,
                        ReferenceFrame reference, Jacobian& J) noexcept;

}  // namespace thing_kin
