// What Pinocchio's users write with it in Eigen.

#include <cmath>
#include <numbers>

#include <Eigen/QR>
#include <Eigen/SVD>

#include "pinocchio.hpp"

namespace {

namespace pin = pinocchio;
using bench::Matrix69;
using bench::Problem;
using bench::Vector9;

// The smallest step, and nothing besides.
using Cod = Eigen::CompleteOrthogonalDecomposition<Matrix69>;

// The smallest step and the singular values, which damping needs; bounded, it does not allocate.
struct ThinSvd : Eigen::JacobiSVD<Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 9>> {
  explicit ThinSvd(const Matrix69& J) : JacobiSVD(J, Eigen::ComputeThinU | Eigen::ComputeThinV) {}
};

struct Peer : bench::PinocchioPeer {
  template <typename Decomposition>
  Vector9 velocity(const Problem::Input& input) {
    return Decomposition(jacobian(input.q)).solve(input.twist);
  }

  // [M17] (4.18): the hand, then the base in what is left.
  template <typename Decomposition>
  Vector9 step(const Problem::Input& input) {
    jacobian(input.q);
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
