#include "kdl.hpp"

#include <memory>

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolvervel_pinv.hpp>
#include <kdl/chainjnttojacdotsolver.hpp>
#include <kdl/chainjnttojacsolver.hpp>

namespace {

using bench::Problem;

// Inputs as KDL's users have them, so that no conversion is timed.
struct Peer {
  KDL::Chain chain = bench::chain_of(bench::problem().robot);
  std::vector<KDL::JntArray> q;
  std::vector<KDL::JntArrayVel> moving;
  std::vector<KDL::Twist> twists;
  KDL::ChainFkSolverPos_recursive fk{chain};
  KDL::ChainJntToJacSolver jacobian{chain};
  KDL::ChainJntToJacDotSolver jacobian_dot{chain};
  KDL::ChainIkSolverVel_pinv velocity{chain};
  KDL::Frame frame;
  KDL::Jacobian J{9};
  KDL::Twist drift;
  KDL::JntArray qd{9};

  Peer() {
    for (const Problem::Input& input : bench::problem().inputs) {
      q.push_back(bench::to_kdl(input.q.data()));
      moving.emplace_back(q.back(), bench::to_kdl(input.qd.data()));
      const auto& t = input.twist;
      twists.emplace_back(KDL::Vector(t[0], t[1], t[2]), KDL::Vector(t[3], t[4], t[5]));
    }
  }
};

std::size_t place(const Problem::Input& input) {
  return static_cast<std::size_t>(&input - bench::problem().inputs.data());
}

void enter_second_order(const std::shared_ptr<Peer>& peer) {
  bench::enter(
      "jacobian_dot", "kdl",
      [peer](const Problem::Input& input) -> const auto& {
        peer->jacobian_dot.JntToJacDot(peer->moving[place(input)], peer->J);
        return peer->J.data;
      },
      bench::as_it_is);
  bench::enter(
      "drift", "kdl",
      [peer](const Problem::Input& input) -> const auto& {
        peer->jacobian_dot.JntToJacDot(peer->moving[place(input)], peer->drift);
        return peer->drift;
      },
      [](const KDL::Twist& t) {
        return Eigen::Matrix<double, 6, 1>(t[0], t[1], t[2], t[3], t[4], t[5]);
      });
}

[[maybe_unused]] const bool entered = [] {
  const auto peer = std::make_shared<Peer>();
  enter_second_order(peer);
  bench::enter(
      "fk", "kdl",
      [peer](const Problem::Input& input) -> const KDL::Frame& {
        peer->fk.JntToCart(peer->q[place(input)], peer->frame);
        return peer->frame;
      },
      bench::to_matrix);
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
