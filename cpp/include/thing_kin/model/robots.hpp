#pragma once

#include <array>
#include <optional>

#include "thing_kin/model/chain.hpp"
#include "thing_kin/model/omni_base.hpp"
#include "thing_kin/model/ur_calibration.hpp"

/// The robots of the two theses. Sources of the limits stand with the numbers in robots.cpp.
namespace thing_kin::robots {

Chain ur5();
Chain ur10();

/// The arm as calibrated, with the same joints, limits and frames: frame k, which its
/// Denavit-Hartenberg row puts on the axis of joint k + 1, is on that axis as measured. The root is
/// the driver's `base`, the tool its `tool0`.
Chain ur5(const UrCalibration& calibration);
Chain ur10(const UrCalibration& calibration);

/// Limits of the Ridgeback's x, y, theta.
BaseLimits ridgeback_limits();

/// Limits of the Pioneer LX as a virtual omnidirectional base.
BaseLimits pioneer_lx_limits();

/// Ridgeback + UR10, [M17] Table A.1.
Chain thing(JointOrder order = JointOrder::kArmFirst,
            const BaseLimits& base_limits = ridgeback_limits());

/// Where the UR5 stands on the Pioneer LX unless the caller knows better: on the middle of the
/// deck, 0.075 m ahead of the center of rotation and 0.448 m above the floor, not turned.
SE3 default_pioneer_lx_mount();

/// Pioneer LX + UR5, [X21] 4.1. The real base has two driven wheels and cannot move sideways.
Chain pioneer_lx_ur5(const SE3& mount = default_pioneer_lx_mount(),
                     JointOrder order = JointOrder::kArmFirst,
                     const BaseLimits& base_limits = pioneer_lx_limits());

}  // namespace thing_kin::robots
