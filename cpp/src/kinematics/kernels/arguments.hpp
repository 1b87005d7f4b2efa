#pragma once

#include "kernels.hpp"
#include "thing_kin/kinematics/jacobian.hpp"

namespace thing_kin {

/// A point as a frame of its own, with the axes of the one it is fixed to.
inline SkeletonFrame skeleton_frame_at(const Chain& chain, const MovingPoint& of) noexcept {
  SkeletonFrame frame = chain.skeleton_frame(of.frame);
  const Eigen::Map<const Eigen::Matrix<double, 4, 3>> axes(frame.offset);
  const Eigen::Vector4d shift = axes * of.point;
  Eigen::Map<Eigen::Vector4d>{frame.offset + 12} += shift;
  return frame;
}

}  // namespace thing_kin
