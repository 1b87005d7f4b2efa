#pragma once

#include <span>

#include "thing_kin/model/chain.hpp"

namespace thing_kin {

Skeleton make_skeleton(std::span<const Chain::Joint> joints);

/// The frame's offset from the skeleton's frame of its last joint.
SkeletonFrame make_skeleton_frame(std::span<const Chain::Joint> joints, const Chain::Frame& frame);

}  // namespace thing_kin
