#include "thing_kin/inverse/damped_step.hpp"

#include <algorithm>
#include <cmath>

namespace thing_kin {

namespace {

// The part of dq that no rotary joint turns by more than `most` in.
double shortened(const JointBox& box, const JointVector& dq, double most) noexcept {
  double turn = 0.0;
  for (Eigen::Index j = 0; j < dq.size(); ++j) {
    turn = box.is_rotary(j) ? std::max(turn, std::abs(dq[j])) : turn;
  }
  return turn > most ? most / turn : 1.0;
}

}  // namespace

void take_damped_step(const Jacobian& J, const RowFactors& M, Vector6 e,
                      const JointVector& mobility, const double* z, const StepDamping& damping,
                      const JointBox& box, JointVector& q) noexcept {
  const Eigen::Index n = J.cols();
  JointVector next = q;
  JointVector free = mobility;  // 0: on a side of the box
  JointVector dq(n);
  for (Eigen::Index j = 0; z != nullptr && j < n; ++j) {
    e -= z[j] * (M * J.col(j));
  }
  for (Eigen::Index round = 0; round <= n; ++round) {
    damped_inverse(J, M, free.data(), damping.lambda, e, dq.data());
    for (Eigen::Index j = 0; z != nullptr && j < n; ++j) {
      dq[j] += free[j] > 0.0 ? z[j] : 0.0;
    }
    const double part = shortened(box, dq, damping.largest_turn);
    bool again = false;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (free[j] == 0.0) {
        continue;
      }
      const double x = q[j] + part * dq[j];
      next[j] = box.inside(j, x);
      if (next[j] != x && !box.is_endless(j)) {
        free[j] = 0.0;
        e -= (next[j] - q[j] - (z != nullptr ? z[j] : 0.0)) * (M * J.col(j));
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
