#include "thing_kin/kinematics/jacobian_dot.hpp"

#include <Eigen/Geometry>

namespace thing_kin {

namespace {

// The sum of the Hessian's columns (hessian.cpp) over k: a bracket with the twist of the joints
// inside (world) or outside (body) of joint i, kept as a running sum.

void differentiate_world(const Chain& chain, const Jacobian& J, const double* qd, Jacobian& dJ) {
  Vector6 inside = Vector6::Zero();
  for (const Chain::Joint& joint : chain.joints()) {
    const Vector6 column = J.col(joint.index);
    dJ.col(joint.index) = se3_bracket(inside, column);
    inside += qd[joint.index] * column;
  }
}

void differentiate_body(const Chain& chain, const Jacobian& J, const double* qd, Jacobian& dJ) {
  Vector6 outside = Vector6::Zero();
  const auto joints = chain.joints();
  for (std::size_t i = joints.size(); i-- > 0;) {
    const int index = joints[i].index;
    const Vector6 column = J.col(index);
    dJ.col(index) = se3_bracket(column, outside);
    outside += qd[index] * column;
  }
}

// The joints inside and joint i itself turn its column; those outside move the point.
void differentiate_world_aligned(const Chain& chain, const Jacobian& J, const double* qd,
                                 Jacobian& dJ) {
  const auto joints = chain.joints();
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  for (std::size_t i = joints.size(); i-- > 0;) {
    const int index = joints[i].index;
    dJ.col(index) << J.col(index).tail<3>().cross(motion), Eigen::Vector3d::Zero();
    motion += qd[index] * J.col(index).head<3>();
  }
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();
  for (const Chain::Joint& joint : joints) {
    const auto column = J.col(joint.index);
    spin += qd[joint.index] * column.tail<3>();
    dJ.col(joint.index).head<3>() += spin.cross(column.head<3>());
    dJ.col(joint.index).tail<3>() = spin.cross(column.tail<3>());
  }
}

}  // namespace

void geometric_jacobian_dot(const Chain& chain, const Posture& posture, const MovingPoint& of,
                            ReferenceFrame reference, const double* qd, Jacobian& dJ) noexcept {
  Jacobian J;
  geometric_jacobian(chain, posture, of, reference, J);
  dJ.resize(6, chain.dof());
  switch (reference) {
    case ReferenceFrame::kWorldAligned:
      return differentiate_world_aligned(chain, J, qd, dJ);
    case ReferenceFrame::kBody:
      return differentiate_body(chain, J, qd, dJ);
    case ReferenceFrame::kWorld:
      return differentiate_world(chain, J, qd, dJ);
  }
}

}  // namespace thing_kin
