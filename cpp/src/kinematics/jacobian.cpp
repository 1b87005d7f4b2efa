#include "thing_kin/kinematics/jacobian.hpp"

#include <Eigen/Geometry>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

ReferenceFrame reference_frame_from_string(const std::string& name) {
  if (name == "world_aligned") {
    return ReferenceFrame::kWorldAligned;
  }
  if (name == "body") {
    return ReferenceFrame::kBody;
  }
  if (name == "world") {
    return ReferenceFrame::kWorld;
  }
  throw InvalidArgument("frame", quoted(name), "'world_aligned', 'body' or 'world'");
}

void geometric_jacobian(const Chain& chain, const Posture& posture, int frame,
                        ReferenceFrame reference, Jacobian& J) noexcept {
  const SE3 T = frame_pose(chain, posture, frame);
  // The spatial twist is the velocity of the point at the root's origin.
  const Eigen::Vector3d point =
      reference == ReferenceFrame::kWorld ? Eigen::Vector3d::Zero() : T.translation;
  const int moving = chain.frames()[static_cast<std::size_t>(frame)].joints;
  const auto joints = chain.joints();
  J.resize(6, chain.dof());
  for (int i = 0; i < chain.dof(); ++i) {
    const Chain::Joint& joint = joints[static_cast<std::size_t>(i)];
    auto column = J.col(joint.index);
    if (i >= moving) {
      column.setZero();
      continue;
    }
    const SE3& at = posture.joint[static_cast<std::size_t>(i)];
    Eigen::Vector3d z = at.rotation.col(2);
    if (joint.type == JointType::kPrismatic) {
      if (reference == ReferenceFrame::kBody) {
        z = T.rotation.transpose() * z;
      }
      column << z, Eigen::Vector3d::Zero();
      continue;
    }
    Eigen::Vector3d v = z.cross(point - at.translation);
    if (reference == ReferenceFrame::kBody) {
      v = T.rotation.transpose() * v;
      z = T.rotation.transpose() * z;
    }
    column << v, z;
  }
}

}  // namespace thing_kin
