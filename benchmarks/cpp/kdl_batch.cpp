// A loop over the rows with KDL's solvers, in and out of KDL's types.

#include <memory>

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "kdl.hpp"

namespace {

using bench::kRows;

struct Loop {
  KDL::Chain chain = bench::chain_of(bench::problem().robot);
  KDL::ChainFkSolverPos_recursive fk{chain};
  KDL::ChainJntToJacSolver jacobian{chain};
  std::vector<KDL::JntArray> q;
  std::vector<KDL::Frame> poses{kRows};
  std::vector<KDL::Jacobian> jacobians{kRows, KDL::Jacobian(9)};

  Loop() {
    for (std::size_t i = 0; i < kRows; ++i) {
      q.push_back(bench::to_kdl(bench::problem().row(i)));
    }
  }

  const Loop& fk_batch() {
    for (std::size_t i = 0; i < kRows; ++i) {
      fk.JntToCart(q[i], poses[i]);
    }
    return *this;
  }

  const Loop& fk_and_jacobian_batch() {
    for (std::size_t i = 0; i < kRows; ++i) {
      jacobian.JntToJac(q[i], jacobians[i]);
    }
    return fk_batch();
  }
};

// One column: poses, then Jacobians, row by row.
Eigen::VectorXd poses_of(const Loop& loop) {
  Eigen::VectorXd all(16 * kRows);
  for (std::size_t i = 0; i < kRows; ++i) {
    const Eigen::Matrix4d transposed = bench::to_matrix(loop.poses[i]).transpose();
    all.segment<16>(16 * static_cast<long>(i)) = transposed.reshaped();
  }
  return all;
}

Eigen::VectorXd all_of(const Loop& loop) {
  Eigen::VectorXd all(70 * kRows);
  all.head(16 * kRows) = poses_of(loop);
  for (std::size_t i = 0; i < kRows; ++i) {
    const Eigen::MatrixXd transposed = loop.jacobians[i].data.transpose();
    all.segment<54>(static_cast<long>(16 * kRows + 54 * i)) = transposed.reshaped();
  }
  return all;
}

[[maybe_unused]] const bool entered = [] {
  const auto peer = std::make_shared<Loop>();
  bench::enter_batch(
      "fk_batch", "kdl", [peer]() -> const auto& { return peer->fk_batch(); }, poses_of);
  bench::enter_batch(
      "fk_and_jacobian_batch", "kdl",
      [peer]() -> const auto& { return peer->fk_and_jacobian_batch(); }, all_of);
  return true;
}();

}  // namespace
