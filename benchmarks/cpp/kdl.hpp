#pragma once

// KDL's model of the same chain, and its types.

#include <kdl/chain.hpp>
#include <kdl/jntarray.hpp>

#include "problem.hpp"

namespace bench {

inline KDL::Frame to_kdl(const thing_kin::SE3& T) {
  const Eigen::Matrix3d& R = T.rotation;
  return {KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1),
                        R(2, 2)),
          KDL::Vector(T.translation.x(), T.translation.y(), T.translation.z())};
}

// Constant transforms are folded into the segments: one for each joint, and one for the root.
inline KDL::Chain chain_of(const thing_kin::Chain& robot) {
  const auto joints = robot.joints();
  KDL::Chain chain;
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), to_kdl(joints[0].fixed)));
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto axis = thing_kin::is_rotary(joints[i].type) ? KDL::Joint::RotZ : KDL::Joint::TransZ;
    const thing_kin::SE3& tip =
        i + 1 < joints.size() ? joints[i + 1].fixed : robot.frames().back().offset;
    chain.addSegment(KDL::Segment(KDL::Joint(axis), to_kdl(tip)));
  }
  return chain;
}

inline KDL::JntArray to_kdl(const double* q) {
  KDL::JntArray array(9);
  array.data = Eigen::Map<const Vector9>(q);
  return array;
}

inline Eigen::Matrix4d to_matrix(const KDL::Frame& frame) {
  Eigen::Matrix4d T;
  for (int row = 0; row < 4; ++row) {
    for (int col = 0; col < 4; ++col) {
      T(row, col) = frame(row, col);
    }
  }
  return T;
}

}  // namespace bench
