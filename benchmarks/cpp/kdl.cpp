#include <memory>

#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolvervel_pinv.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "problem.hpp"

namespace {

using bench::Problem;

KDL::Frame to_kdl(const thing_kin::SE3& T) {
  const Eigen::Matrix3d& R = T.rotation;
  return {KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1),
                        R(2, 2)),
          KDL::Vector(T.translation.x(), T.translation.y(), T.translation.z())};
}

// Constant transforms are folded into the segments: one for each joint, and one for the root.
KDL::Chain chain_of(const thing_kin::Chain& robot) {
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

// Inputs as KDL's users have them, so that no conversion is timed.
struct Peer {
  KDL::Chain chain = chain_of(bench::problem().robot);
  std::vector<KDL::JntArray> q;
  std::vector<KDL::Twist> twists;
  KDL::ChainFkSolverPos_recursive fk{chain};
  KDL::ChainJntToJacSolver jacobian{chain};
  KDL::ChainIkSolverVel_pinv velocity{chain};
  KDL::Frame frame;
  KDL::Jacobian J{9};
  KDL::JntArray qd{9};

  Peer() {
    for (const Problem::Input& input : bench::problem().inputs) {
      q.emplace_back(9);
      q.back().data = input.q;
      const auto& t = input.twist;
      twists.emplace_back(KDL::Vector(t[0], t[1], t[2]), KDL::Vector(t[3], t[4], t[5]));
    }
  }
};

std::size_t place(const Problem::Input& input) {
  return static_cast<std::size_t>(&input - bench::problem().inputs.data());
}

Eigen::Matrix4d to_matrix(const KDL::Frame& frame) {
  Eigen::Matrix4d T;
  for (int row = 0; row < 4; ++row) {
    for (int col = 0; col < 4; ++col) {
      T(row, col) = frame(row, col);
    }
  }
  return T;
}

[[maybe_unused]] const bool entered = [] {
  const auto peer = std::make_shared<Peer>();
  bench::enter(
      "fk", "kdl",
      [peer](const Problem::Input& input) -> const KDL::Frame& {
        peer->fk.JntToCart(peer->q[place(input)], peer->frame);
        return peer->frame;
      },
      to_matrix);
  bench::enter(
      "fk_and_jacobian", "kdl",
      [peer](const Problem::Input& input) -> const auto& {
        peer->jacobian.JntToJac(peer->q[place(input)], peer->J);
        return peer->J.data;
      },
      bench::as_it_is);
  bench::enter(
      "velocity", "kdl",
      [peer](const Problem::Input& input) -> const auto& {
        const std::size_t i = place(input);
        peer->velocity.CartToJnt(peer->q[i], peer->twists[i], peer->qd);
        return peer->qd.data;
      },
      bench::as_it_is);
  return true;
}();

}  // namespace
