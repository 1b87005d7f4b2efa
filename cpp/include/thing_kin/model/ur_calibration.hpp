#pragma once

#include <array>

#include <Eigen/Core>

namespace thing_kin {

/// An arm of Universal Robots as measured in the factory: what the maker's driver writes into
/// `<robot>_calibration.yaml`, the URDF origin of each joint in the link before, about whose z the
/// joint turns.
struct UrCalibration {
  struct Origin {
    Eigen::Vector3d xyz = Eigen::Vector3d::Zero();  ///< m
    Eigen::Vector3d rpy = Eigen::Vector3d::Zero();  ///< rad, Rz(yaw) Ry(pitch) Rx(roll)
  };
  static constexpr std::array<const char*, 6> kLinks{"shoulder", "upper_arm", "forearm",
                                                     "wrist_1",  "wrist_2",   "wrist_3"};
  std::array<Origin, 6> origins;  ///< in the order of kLinks
};

/// Throws InvalidArgument, naming the link, for what is not finite, more than 10 m or more than a
/// turn: no arm of theirs is that long, and most likely the units are wrong.
void check(const UrCalibration& calibration);

}  // namespace thing_kin
