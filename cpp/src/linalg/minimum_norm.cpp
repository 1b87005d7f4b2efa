#include "thing_kin/linalg/minimum_norm.hpp"

#include <algorithm>
#include <cmath>

namespace thing_kin {

namespace {

// With column pivoting sigma_m/sigma_1 is at least |r_mm/r_11| over some 2^m: for so few rows and
// such a ratio no singular value counts as zero.
constexpr Eigen::Index kMaxRows = 8;
constexpr double kClearlyRegular = 1e-6;
// What a projection leaves of a matrix is its rounding below this part of it.
constexpr double kNoise = 1e-9;

}  // namespace

bool MinimumNorm::factor(const SmallMatrix& A, double scale) noexcept {
  const Eigen::Index m = A.rows();
  if (m == 0 || m > A.cols() || m > kMaxRows) {
    return false;
  }
  const double largest = A.cwiseAbs().maxCoeff();
  if (largest <= kNoise * scale) {
    return false;
  }
  unit_ = std::ldexp(1.0, std::ilogb(largest));  // a power of two: scaling is exact
  factors_ = A.transpose() / unit_;
  qr_.factor(factors_);
  const double least = std::abs(factors_(m - 1, m - 1));
  return least > kClearlyRegular * std::abs(factors_(0, 0)) && least * unit_ > kNoise * scale;
}

void MinimumNorm::solve(const double* e, double* x) const noexcept {
  const Eigen::Index m = factors_.cols();
  for (Eigen::Index i = 0; i < m; ++i) {  // forward substitution with R^T
    double sum = e[qr_.pivot(i)];
    for (Eigen::Index j = 0; j < i; ++j) {
      sum -= factors_(j, i) * x[j];
    }
    x[i] = sum / factors_(i, i);
  }
  std::fill(x + m, x + factors_.rows(), 0.0);
  qr_.apply_q(x);
  for (Eigen::Index i = 0; i < factors_.rows(); ++i) {
    x[i] /= unit_;
  }
}

JointVector MinimumNorm::solve(const SmallVector& e) const noexcept {
  JointVector x(factors_.rows());
  solve(e.data(), x.data());
  return x;
}

SmallMatrix MinimumNorm::pseudoinverse() const noexcept {
  const Eigen::Index m = factors_.cols();
  SmallMatrix inverse(factors_.rows(), m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const SmallVector unit = SmallVector::Unit(m, i);
    solve(unit.data(), &inverse(0, i));
  }
  return inverse;
}

SmallMatrix MinimumNorm::null_space() const noexcept {
  const Eigen::Index n = factors_.rows();
  const Eigen::Index m = factors_.cols();
  SmallMatrix Z = SmallMatrix::Zero(n, n - m);
  for (Eigen::Index j = 0; j < n - m; ++j) {
    Z(m + j, j) = 1.0;
    qr_.apply_q(&Z(0, j));
  }
  return Z;
}

}  // namespace thing_kin
