#include "thing_kin/kinematics/posture.hpp"

#include <cmath>

namespace thing_kin {

namespace {

// T <- T * joint(q): a turn about z mixes the first two columns, a slide moves along the third.
void move(SE3& T, JointType type, double q) {
  if (type == JointType::kPrismatic) {
    T.translation += q * T.rotation.col(2);
    return;
  }
  const double c = std::cos(q);
  const double s = std::sin(q);
  const Eigen::Vector3d x = T.rotation.col(0);
  const Eigen::Vector3d y = T.rotation.col(1);
  T.rotation.col(0) = c * x + s * y;
  T.rotation.col(1) = c * y - s * x;
}

// Calls visit(i, frame of joint i) from the root up to `count` joints.
template <typename Visit>
void walk(const Chain& chain, const double* q, int count, Visit visit) {
  SE3 T;
  const auto joints = chain.joints();
  for (int i = 0; i < count; ++i) {
    const Chain::Joint& joint = joints[static_cast<std::size_t>(i)];
    T = i == 0 ? joint.fixed : T * joint.fixed;
    move(T, joint.type, q[joint.index]);
    visit(i, T);
  }
}

}  // namespace

void place_joints(const Chain& chain, const double* q, Posture& posture) noexcept {
  walk(chain, q, chain.dof(),
       [&](int i, const SE3& T) { posture.joint[static_cast<std::size_t>(i)] = T; });
}

SE3 frame_pose(const Chain& chain, const Posture& posture, int frame) noexcept {
  const Chain::Frame& f = chain.frames()[static_cast<std::size_t>(frame)];
  return f.joints == 0 ? f.offset
                       : posture.joint[static_cast<std::size_t>(f.joints - 1)] * f.offset;
}

SE3 forward_kinematics(const Chain& chain, const double* q, int frame) noexcept {
  const Chain::Frame& f = chain.frames()[static_cast<std::size_t>(frame)];
  SE3 T;
  walk(chain, q, f.joints, [&](int, const SE3& moved) { T = moved; });
  return f.joints == 0 ? f.offset : T * f.offset;
}

}  // namespace thing_kin
