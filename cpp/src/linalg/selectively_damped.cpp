#include "thing_kin/linalg/selectively_damped.hpp"

#include <algorithm>
#include <cmath>

namespace thing_kin {

namespace {

// rho_j/sigma_1, rho_j = sum_l ||dp_l/dq_j||: how far the blocks move with joint j, from
// A = U diag(sigma) V^T. Relative to sigma_1, so that no square overflows.
JointVector block_motion(const Svd& svd, const RowBlocks& blocks) {
  const SmallMatrix scaled = svd.u * (svd.sigma / svd.sigma[0]).asDiagonal();
  const SmallMatrix A = scaled * svd.thin_v().transpose();
  JointVector rho = JointVector::Zero(A.cols());
  int row = 0;
  for (int b = 0; b < blocks.count; ++b) {
    const int size = blocks.size[static_cast<std::size_t>(b)];
    rho += A.middleRows(row, size).colwise().norm().transpose();
    row += size;
  }
  return rho;
}

// N_i: the sum of the norms of the blocks of u_i.
double block_norm_sum(const Svd& svd, const RowBlocks& blocks, int i) {
  double sum = 0.0;
  int row = 0;
  for (int b = 0; b < blocks.count; ++b) {
    const int size = blocks.size[static_cast<std::size_t>(b)];
    sum += svd.u.col(i).segment(row, size).norm();
    row += size;
  }
  return sum;
}

}  // namespace

void clamp_max_abs(JointVector& v, double bound) noexcept {
  const double largest = v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0;
  if (largest > bound) {
    v *= bound / largest;
  }
}

JointVector selectively_damped_step(const Svd& svd, const RowBlocks& blocks, const SmallVector& e,
                                    double gamma_max) noexcept {
  JointVector step = JointVector::Zero(svd.v.rows());
  if (svd.rank == 0) {
    return step;
  }
  const JointVector rho = block_motion(svd, blocks);
  for (int i = 0; i < svd.rank; ++i) {
    const auto v = svd.v.col(i);
    const double N = block_norm_sum(svd, blocks, i);
    const double M = v.cwiseAbs().dot(rho) * (svd.sigma[0] / svd.sigma[i]);
    const double gamma = gamma_max * std::min(1.0, N / M);
    JointVector phi = (svd.u.col(i).dot(e) / svd.sigma[i]) * v;
    clamp_max_abs(phi, gamma);
    step += phi;
  }
  clamp_max_abs(step, gamma_max);
  return step;
}

}  // namespace thing_kin
