// Pinocchio's own kinematics; the inverse steps are what its users write with it, in Eigen.

#include <cmath>
#include <memory>
#include <numbers>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>

#include "problem.hpp"

namespace {

namespace pin = pinocchio;
using bench::Matrix69;
using bench::Problem;
using bench::Vector9;

pin::SE3 to_pinocchio(const thing_kin::SE3& T) { return {T.rotation, T.translation}; }

pin::Model model_of(const thing_kin::Chain& robot) {
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

// The smallest step, and nothing besides.
using Cod = Eigen::CompleteOrthogonalDecomposition<Matrix69>;

// The smallest step and the singular values, which damping needs; bounded, it does not allocate.
struct ThinSvd : Eigen::JacobiSVD<Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 9>> {
  explicit ThinSvd(const Matrix69& J) : JacobiSVD(J, Eigen::ComputeThinU | Eigen::ComputeThinV) {}
};

struct Peer {
  pin::Model model = model_of(bench::problem().robot);
  pin::Data data{model};
  pin::FrameIndex tool = model.getFrameId("tool");
  Matrix69 J = Matrix69::Zero();

  const pin::SE3& fk(const Problem::Input& input) {
    pin::forwardKinematics(model, data, input.q);
    return pin::updateFramePlacement(model, data, tool);
  }

  // All joints' Jacobian, then the frame's.
  const Matrix69& jacobian(const Problem::Input& input) {
    pin::computeJointJacobians(model, data, input.q);
    pin::updateFramePlacement(model, data, tool);
    pin::getFrameJacobian(model, data, tool, pin::LOCAL_WORLD_ALIGNED, J);
    return J;
  }

  // The frame's alone.
  const Matrix69& frame_jacobian(const Problem::Input& input) {
    pin::computeFrameJacobian(model, data, input.q, tool, pin::LOCAL_WORLD_ALIGNED, J);
    return J;
  }

  template <typename Decomposition>
  Vector9 velocity(const Problem::Input& input) {
    return Decomposition(jacobian(input)).solve(input.twist);
  }

  // [M17] (4.18): the hand, then the base in what is left.
  template <typename Decomposition>
  Vector9 step(const Problem::Input& input) {
    jacobian(input);
    const pin::SE3& T = data.oMf[tool];
    Eigen::Matrix<double, 6, 1> error;
    error << input.T_goal.translation - T.translation(),
        pin::log3(Eigen::Matrix3d(input.T_goal.rotation * T.rotation().transpose()));
    Vector9 base = Vector9::Zero();
    base.head<3>() = input.base_goal - input.q.head<3>();
    base[2] = std::remainder(base[2], 2 * std::numbers::pi);
    const Decomposition decomposition(J);
    return base + decomposition.solve(error - J * base);
  }
};

[[maybe_unused]] const bool entered = [] {
  const auto peer = std::make_shared<Peer>();
  using Input = Problem::Input;
  const auto pose = [](const pin::SE3& T) { return T.toHomogeneousMatrix(); };
  bench::enter(
      "fk", "pinocchio", [peer](const Input& x) -> const auto& { return peer->fk(x); }, pose);
  bench::enter(
      "fk_and_jacobian", "pinocchio",
      [peer](const Input& x) -> const auto& { return peer->jacobian(x); }, bench::as_it_is);
  bench::enter(
      "fk_and_jacobian", "pinocchio_frame",
      [peer](const Input& x) -> const auto& { return peer->frame_jacobian(x); }, bench::as_it_is);
  bench::enter(
      "velocity", "pinocchio_cod", [peer](const Input& x) { return peer->velocity<Cod>(x); },
      bench::as_it_is);
  bench::enter(
      "velocity", "pinocchio_svd", [peer](const Input& x) { return peer->velocity<ThinSvd>(x); },
      bench::as_it_is);
  bench::enter(
      "step", "pinocchio_cod", [peer](const Input& x) { return peer->step<Cod>(x); },
      bench::as_it_is);
  bench::enter(
      "step", "pinocchio_svd", [peer](const Input& x) { return peer->step<ThinSvd>(x); },
      bench::as_it_is);
  return true;
}();

}  // namespace
