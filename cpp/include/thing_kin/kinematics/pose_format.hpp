#pragma once

// An enumeration alone: the kernels, which share no inline function with the rest, include it.

namespace thing_kin {

/// How a pose is written in a batch.
enum class PoseFormat : unsigned char {
  kMatrix,              ///< (4, 4), row-major
  kPositionQuaternion,  ///< [x, y, z, w, x, y, z] with w >= 0
};

}  // namespace thing_kin
