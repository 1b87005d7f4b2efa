#include "thing_kin/linalg/regularized_rows.hpp"

#include <algorithm>
#include <cmath>

namespace thing_kin {

namespace {

// With column pivoting the last diagonal entry of R shows a lost rank but for a factor of 2^m: far
// above it the singular values need not be asked.
constexpr double kClearlyRegular = 1e-6;
// The Cholesky factor below squares R: half of the digits must be enough.
constexpr double kWellConditioned = 1e-3;
constexpr Eigen::Index kMaxRows = 8;
// Rows that are the rest of a projection carry its rounding, and that of the projections before: a
// singular value below this part of the whole is noise. What moves along it moves the rows by less.
constexpr double kNoise = 1e-11;

int rank_of(const Svd& svd, double scale) {
  int rank = svd.rank;
  while (rank > 0 && svd.sigma[rank - 1] <= kNoise * std::max(scale, svd.sigma[0])) {
    --rank;
  }
  return rank;
}

bool regular(const SmallMatrix& R, Eigen::Index rank, double scale, double ratio) {
  return std::abs(R(rank - 1, rank - 1)) > ratio * std::max(std::abs(R(0, 0)), scale);
}

// x <- U^-T x for the upper triangle of the leading n x n block.
void solve_transposed(const SmallMatrix& U, Eigen::Index n, double* x) {
  for (Eigen::Index i = 0; i < n; ++i) {
    double sum = x[i];
    for (Eigen::Index j = 0; j < i; ++j) {
      sum -= U(j, i) * x[j];
    }
    x[i] = sum / U(i, i);
  }
}

// x <- U^-1 x.
void solve_upper(const SmallMatrix& U, Eigen::Index n, double* x) {
  for (Eigen::Index i = n - 1; i >= 0; --i) {
    double sum = x[i];
    for (Eigen::Index j = i + 1; j < n; ++j) {
      sum -= U(i, j) * x[j];
    }
    x[i] = sum / U(i, i);
  }
}

// Upper triangular S with S^T S = R R^T + damping.
void damped_root(const SmallMatrix& R, Eigen::Index n, double damping, SmallMatrix& S) {
  S.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i; j < n; ++j) {
      double sum = i == j ? damping : 0.0;
      for (Eigen::Index k = j; k < n; ++k) {
        sum += R(i, k) * R(j, k);
      }
      for (Eigen::Index k = 0; k < i; ++k) {
        sum -= S(k, i) * S(k, j);
      }
      S(i, j) = i == j ? std::sqrt(sum) : sum / S(i, i);
    }
  }
}

}  // namespace

void RegularizedRows::factor(const SmallMatrix& M, double scale,
                             const Regularization& regularization) noexcept {
  const Eigen::Index m = M.rows();
  damped_ = regularization.damping > 0.0;
  regular_ = false;
  rank_ = 0;
  if (m == 0 || M.cols() == 0) {
    svd_.v.setIdentity(M.cols(), M.cols());
    return;
  }
  if (m <= std::min(M.cols(), kMaxRows) && regularization.filter == nullptr) {
    factors_ = M.transpose();
    qr_.factor(factors_);
    regular_ = regular(factors_, m, scale, damped_ ? kWellConditioned : kClearlyRegular);
  }
  if (regular_) {
    rank_ = static_cast<int>(m);
    if (damped_) {
      damped_root(factors_, m, regularization.damping, root_);
    }
    return;
  }
  decompose(M, svd_, scale);
  rank_ = rank_of(svd_, scale);
  lifted_ = svd_.sigma.head(rank_);
  if (regularization.filter != nullptr) {
    for (double& sigma : lifted_) {
      sigma = (*regularization.filter)(sigma);
    }
  }
  length_ = (lifted_.array().square() + regularization.damping).sqrt();
}

// s with |L y - r|^2 + damping |y|^2 = |S y - s|^2 + constant, S^T S = L^T L + damping.
void RegularizedRows::right_hand_side(const SmallVector& r, SmallVector& s) const noexcept {
  if (!regular_) {
    s = svd_.u.leftCols(rank_).transpose() * r;
    s.array() *= lifted_.array() / length_.array();
    return;
  }
  SmallVector permuted(rank_);
  for (Eigen::Index i = 0; i < rank_; ++i) {
    permuted[i] = r[qr_.pivot(i)];
  }
  s = factors_.topRows(rank_).triangularView<Eigen::Upper>() * permuted;
  solve_transposed(root_, rank_, s.data());
}

void RegularizedRows::solve(const SmallVector& r, SmallVector& z) const noexcept {
  if (!regular_) {
    right_hand_side(r, z);
    z.array() /= length_.array();
    const SmallVector y = z;
    z.noalias() = svd_.v.leftCols(rank_) * y;
    return;
  }
  const Eigen::Index f = factors_.rows();
  if (damped_) {
    right_hand_side(r, z);
    solve_upper(root_, rank_, z.data());
    z.conservativeResize(f);
  } else {
    z.resize(f);
    for (Eigen::Index i = 0; i < rank_; ++i) {
      z[i] = r[qr_.pivot(i)];
    }
    solve_transposed(factors_, rank_, z.data());
  }
  z.tail(f - rank_).setZero();
  qr_.apply_q(z.data());
}

void RegularizedRows::null_space(SmallMatrix& V2) const noexcept {
  if (!regular_) {
    V2 = svd_.v.rightCols(svd_.v.cols() - rank_);
    return;
  }
  const Eigen::Index f = factors_.rows();
  V2.setZero(f, f - rank_);
  for (Eigen::Index j = 0; j < f - rank_; ++j) {
    V2(rank_ + j, j) = 1.0;
    qr_.apply_q(&V2(0, j));
  }
}

void RegularizedRows::square_root(const SmallMatrix& M, const SmallVector& r, SmallMatrix& K,
                                  SmallVector& s) const noexcept {
  if (regular_ && !damped_) {
    K = M;
    s = r;
    return;
  }
  right_hand_side(r, s);
  if (!regular_) {
    K = length_.asDiagonal() * svd_.v.leftCols(rank_).transpose();
    return;
  }
  SmallMatrix V1 = SmallMatrix::Zero(factors_.rows(), rank_);
  for (Eigen::Index j = 0; j < rank_; ++j) {
    V1(j, j) = 1.0;
    qr_.apply_q(&V1(0, j));
  }
  K.noalias() = root_.triangularView<Eigen::Upper>() * V1.transpose();
}

namespace {

// By QR of M if it is tall, of its transpose if not; false if M may lack rank.
bool solve_regular(const SmallMatrix& M, const SmallVector& r, double scale, SmallVector& t) {
  const Eigen::Index rows = M.rows();
  const Eigen::Index cols = M.cols();
  const Eigen::Index rank = std::min(rows, cols);
  if (rank > kMaxRows) {
    return false;
  }
  PivotedQr qr;
  SmallMatrix R = rows > cols ? M : SmallMatrix(M.transpose());
  qr.factor(R);
  if (!regular(R, rank, scale, kClearlyRegular)) {
    return false;
  }
  t.resize(cols);
  if (rows > cols) {
    SmallVector image = r;
    qr.apply_q_transposed(image.data());
    solve_upper(R, rank, image.data());
    for (Eigen::Index i = 0; i < rank; ++i) {
      t[qr.pivot(i)] = image[i];
    }
    return true;
  }
  for (Eigen::Index i = 0; i < rank; ++i) {
    t[i] = r[qr.pivot(i)];
  }
  solve_transposed(R, rank, t.data());
  t.tail(cols - rank).setZero();
  qr.apply_q(t.data());
  return true;
}

}  // namespace

void least_squares(const SmallMatrix& M, const SmallVector& r, double scale,
                   SmallVector& t) noexcept {
  if (M.rows() == 0 || M.cols() == 0) {
    t.setZero(M.cols());
    return;
  }
  if (solve_regular(M, r, scale, t)) {
    return;
  }
  Svd svd;
  decompose(M, svd, scale);
  const int rank = rank_of(svd, scale);
  SmallVector along = svd.u.leftCols(rank).transpose() * r;
  along.array() /= svd.sigma.head(rank).array();
  t.noalias() = svd.v.leftCols(rank) * along;
}

}  // namespace thing_kin
