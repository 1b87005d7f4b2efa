#pragma once

// An enumeration alone: the kernels, which share no inline function with the rest, include it.

namespace thing_kin {

/// What a Jacobian's rows mean, [linear; angular].
enum class ReferenceFrame : unsigned char {
  kWorldAligned,  ///< velocity of the point, axes of the root
  kBody,          ///< velocity of the point, axes of the frame
  kWorld,  ///< spatial twist: velocity of the point now at the root's origin, axes of the root
};

}  // namespace thing_kin
