#pragma once

// Pinocchio's model of the same chain, and its own kinematics of one posture.

#include <memory>
#include <string>

#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>

#include "problem.hpp"

namespace bench {

namespace pin = pinocchio;

inline pin::SE3 to_pinocchio(const thing_kin::SE3& T) { return {T.rotation, T.translation}; }

inline pin::Model model_of(const thing_kin::Chain& robot) {
  pin::Model model;
  pin::JointIndex joint = 0;
  for (const thing_kin::Chain::Joint& j : robot.joints()) {
    const std::string name = "joint" + std::to_string(joint);
    const pin::SE3 before = to_pinocchio(j.fixed);
    joint = thing_kin::is_rotary(j.type) ? model.addJoint(joint, pin::JointModelRZ(), before, name)
                                         : model.addJoint(joint, pin::JointModelPZ(), before, name);
  }
  const pin::SE3 tool = to_pinocchio(robot.frames().back().offset);
  model.addFrame(pin::Frame("tool", joint, 0, tool, pin::OP_FRAME));
  return model;
}

struct PinocchioPeer {
  pin::Model model = model_of(problem().robot);
  pin::Data data{model};
  pin::FrameIndex tool = model.getFrameId("tool");
  Matrix69 J = Matrix69::Zero();

  template <typename Q>
  const pin::SE3& fk(const Q& q) {
    pin::forwardKinematics(model, data, q);
    return pin::updateFramePlacement(model, data, tool);
  }

  // All joints' Jacobian, then the frame's; its pose is in data.oMf[tool].
  template <typename Q>
  const Matrix69& jacobian(const Q& q) {
    pin::computeJointJacobians(model, data, q);
    pin::updateFramePlacement(model, data, tool);
    pin::getFrameJacobian(model, data, tool, pin::LOCAL_WORLD_ALIGNED, J);
    return J;
  }

  // The frame's alone.
  const Matrix69& frame_jacobian(const Vector9& q) {
    pin::computeFrameJacobian(model, data, q, tool, pin::LOCAL_WORLD_ALIGNED, J);
    return J;
  }

  const Matrix69& jacobian_dot(const Problem::Input& input) {
    pin::computeJointJacobiansTimeVariation(model, data, input.q, input.qd);
    pin::updateFramePlacement(model, data, tool);
    pin::getFrameJacobianTimeVariation(model, data, tool, pin::LOCAL_WORLD_ALIGNED, J);
    return J;
  }

  // The classical acceleration without joint accelerations.
  pin::Motion drift(const Problem::Input& input) {
    static const Vector9 kNone = Vector9::Zero();
    pin::forwardKinematics(model, data, input.q, input.qd, kNone);
    return pin::getFrameClassicalAcceleration(model, data, tool, pin::LOCAL_WORLD_ALIGNED);
  }
};

}  // namespace bench
