#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "thing_kin/model/chain.hpp"

namespace thing_kin {

/// How q lists a mobile manipulator's joints: [q0 ..., x, y, theta], [M17] (3.6), or
/// [x, y, theta, q0 ...].
enum class JointOrder : std::uint8_t { kArmFirst, kBaseFirst };

JointOrder joint_order_from_string(const std::string& name);

/// Limits of x (m), y (m) and theta (rad): +-5 m and +-pi unless given, rates unlimited.
using BaseLimits = std::array<JointLimits, 3>;
BaseLimits default_base_limits();

/// Rows 1-4 of [M17] Table A.1: two prismatic joints and a revolute one that compose to the planar
/// pose (x, y, theta), with frames base_root, base_x, base_y and base.
std::array<Segment, 4> omni_base_segments(const BaseLimits& limits);

/// The arm on an omnidirectional base: `mount` is the pose of the arm's root in the base frame.
/// Throws InvalidArgument if the arm has a base already or a joint or frame name of one.
Chain on_omni_base(const Chain& arm, const SE3& mount,
                   const BaseLimits& limits = default_base_limits(),
                   JointOrder order = JointOrder::kArmFirst, std::string name = "");

}  // namespace thing_kin
