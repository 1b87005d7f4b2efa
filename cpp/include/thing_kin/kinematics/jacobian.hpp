#pragma once

#include <string>
#include <utility>

#include "thing_kin/kinematics/posture.hpp"
#include "thing_kin/kinematics/reference_frame.hpp"

namespace thing_kin {

/// 'world_aligned', 'body' or 'world'; throws InvalidArgument for anything else.
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

inline Jacobian world_aligned_jacobian(const Chain& chain, const Posture& posture, int frame) {
  Jacobian J;
  geometric_jacobian(chain, posture, frame, ReferenceFrame::kWorldAligned, J);
  return J;
}

}  // namespace thing_kin
