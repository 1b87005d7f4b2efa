#include "damped_step.hpp"

#include <bitset>

namespace thing_kin {

namespace {

using Pinned = std::bitset<kMaxDof>;

// A = L D L^T in place, without pivoting: A is positive definite by its damping.
void solve_in_place(Matrix6& A, Vector6& x) noexcept {
  Vector6 inverse;
  for (int k = 0; k < 6; ++k) {
    inverse[k] = 1.0 / A(k, k);
    for (int i = k + 1; i < 6; ++i) {
      const double factor = A(i, k) * inverse[k];
      for (int j = i; j < 6; ++j) {
        A(j, i) -= factor * A(j, k);
      }
      x[i] -= factor * x[k];
    }
  }
  for (int k = 5; k >= 0; --k) {
    for (int i = k + 1; i < 6; ++i) {
      x[k] -= A(i, k) * x[i];
    }
    x[k] *= inverse[k];
  }
}

Vector6 solve_free(const Jacobian& J, const JointVector& mobility, const Pinned& pinned,
                   double lambda, Vector6 e) noexcept {
  Matrix6 A = lambda * Matrix6::Identity();
  for (Eigen::Index j = 0; j < J.cols(); ++j) {
    if (!pinned[static_cast<std::size_t>(j)]) {
      const Vector6 c = J.col(j);
      A.noalias() += c * (mobility[j] * c).transpose();
    }
  }
  solve_in_place(A, e);
  return e;
}

}  // namespace

void take_damped_step(const Jacobian& J, const Vector6& e, const JointVector& mobility,
                      const JointVector& z, const StepDamping& damping, const JointBox& box,
                      JointVector& q) noexcept {
  const Eigen::Index n = J.cols();
  JointVector next = q;
  Vector6 rest = e;
  rest.noalias() -= J * z;
  Pinned pinned;
  for (Eigen::Index round = 0; round <= n; ++round) {
    const Vector6 y = solve_free(J, mobility, pinned, damping.lambda, rest);
    JointVector dq(n);
    double turn = 0.0;
    for (Eigen::Index j = 0; j < n; ++j) {
      dq[j] = pinned[static_cast<std::size_t>(j)] ? 0.0 : z[j] + mobility[j] * J.col(j).dot(y);
      turn = box.is_rotary(j) ? std::max(turn, std::abs(dq[j])) : turn;
    }
    const double scale = turn > damping.largest_turn ? damping.largest_turn / turn : 1.0;
    bool again = false;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (pinned[static_cast<std::size_t>(j)]) {
        continue;
      }
      const double x = q[j] + scale * dq[j];
      next[j] = box.inside(j, x);
      if (next[j] != x && !box.is_endless(j)) {
        pinned.set(static_cast<std::size_t>(j));
        rest -= (next[j] - q[j] - z[j]) * J.col(j);
        again = true;
      }
    }
    if (!again) {
      break;
    }
  }
  q = next;
}

}  // namespace thing_kin
