#include "pinocchio.hpp"

#include <vector>

namespace {

namespace pin = pinocchio;
using bench::kRows;
using bench::Vector9;

// A loop over the rows; results as Pinocchio's users keep them.
struct Loop : bench::PinocchioPeer {
  std::vector<pin::SE3> poses = std::vector<pin::SE3>(kRows);
  std::vector<bench::Matrix69> jacobians = std::vector<bench::Matrix69>(kRows);

  const Loop& fk_batch() {
    for (std::size_t i = 0; i < kRows; ++i) {
      poses[i] = fk(Eigen::Map<const Vector9>(bench::problem().row(i)));
    }
    return *this;
  }

  const Loop& fk_and_jacobian_batch() {
    for (std::size_t i = 0; i < kRows; ++i) {
      jacobians[i] = jacobian(Eigen::Map<const Vector9>(bench::problem().row(i)));
      poses[i] = data.oMf[tool];
    }
    return *this;
  }
};

// One column: poses, then Jacobians, row by row.
Eigen::VectorXd poses_of(const Loop& loop) {
  Eigen::VectorXd all(16 * kRows);
  for (std::size_t i = 0; i < kRows; ++i) {
    const Eigen::Matrix4d transposed = loop.poses[i].toHomogeneousMatrix().transpose();
    all.segment<16>(16 * static_cast<long>(i)) = transposed.reshaped();
  }
  return all;
}

Eigen::VectorXd all_of(const Loop& loop) {
  Eigen::VectorXd all(70 * kRows);
  all.head(16 * kRows) = poses_of(loop);
  for (std::size_t i = 0; i < kRows; ++i) {
    const Eigen::Matrix<double, 9, 6> transposed = loop.jacobians[i].transpose();
    all.segment<54>(static_cast<long>(16 * kRows + 54 * i)) = transposed.reshaped();
  }
  return all;
}

void enter_one_call(const std::shared_ptr<Loop>& peer) {
  using Input = bench::Problem::Input;
  const auto pose = [](const pin::SE3& T) { return T.toHomogeneousMatrix(); };
  const auto motion = [](const pin::Motion& a) { return a.toVector(); };
  bench::enter(
      "fk", "pinocchio", [peer](const Input& x) -> const auto& { return peer->fk(x.q); }, pose);
  bench::enter(
      "fk_and_jacobian", "pinocchio",
      [peer](const Input& x) -> const auto& { return peer->jacobian(x.q); }, bench::as_it_is);
  bench::enter(
      "fk_and_jacobian", "pinocchio_frame",
      [peer](const Input& x) -> const auto& { return peer->frame_jacobian(x.q); }, bench::as_it_is);
  bench::enter(
      "jacobian_dot", "pinocchio",
      [peer](const Input& x) -> const auto& { return peer->jacobian_dot(x); }, bench::as_it_is);
  bench::enter("drift", "pinocchio", [peer](const Input& x) { return peer->drift(x); }, motion);
}

[[maybe_unused]] const bool entered = [] {
  const auto peer = std::make_shared<Loop>();
  enter_one_call(peer);
  bench::enter_batch(
      "fk_batch", "pinocchio", [peer]() -> const auto& { return peer->fk_batch(); }, poses_of);
  bench::enter_batch(
      "fk_and_jacobian_batch", "pinocchio",
      [peer]() -> const auto& { return peer->fk_and_jacobian_batch(); }, all_of);
  return true;
}();

}  // namespace
