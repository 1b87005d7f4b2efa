#include "thing_kin/linalg/regularized_rows.hpp"

#include <algorithm>
#include <cmath>

namespace thing_kin {

namespace {

// Above this part of the whole the smallest singular value is no question of rank.
constexpr double kRegularRows = 1e-7;
// The Cholesky factor below squares R: half of the digits must be enough.
constexpr double kWellConditioned = 1e-4;
// Rows that are the rest of a projection carry its rounding, and that of the projections before: a
// singular value below this part of the whole is noise. What moves along it moves the rows by less.
constexpr double kRowNoise = 1e-11;

int rank_of(const Svd& svd, double scale) {
  int rank = svd.rank;
  while (rank > 0 && svd.sigma[rank - 1] <= kRowNoise * std::max(scale, svd.sigma[0])) {
    --rank;
  }
  return rank;
}

// Upper triangular S with S^T S = R R^T + damping.
template <typename Root>
void damped_root(const RowQr& qr, double damping, Root& S) {
  const int m = qr.rows();
  for (int i = 0; i < m; ++i) {
    for (int j = i; j < m; ++j) {
      double sum = i == j ? damping : 0.0;
      for (int k = j; k < m; ++k) {
        sum += qr.r(i, k) * qr.r(j, k);
      }
      for (int k = 0; k < i; ++k) {
        sum -= S[k][i] * S[k][j];
      }
      S[i][j] = i == j ? std::sqrt(sum) : sum / S[i][i];
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
  if (m <= M.cols() && m <= RowQr::kMaxRows && regularization.filter == nullptr) {
    qr_.factor(M);
    regular_ = qr_.least_singular_value() > (damped_ ? kWellConditioned : kRegularRows) * scale;
  }
  if (regular_) {
    rank_ = static_cast<int>(m);
    if (damped_) {
      damped_root(qr_, regularization.damping, root_);
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
  s.resize(rank_);
  for (int i = 0; i < rank_; ++i) {  // S^T s = R r
    double sum = 0.0;
    for (int k = i; k < rank_; ++k) {
      sum += qr_.r(i, k) * r[k];
    }
    for (int k = 0; k < i; ++k) {
      sum -= root_[k][i] * s[k];
    }
    s[i] = sum / root_[i][i];
  }
}

void RegularizedRows::solve(const SmallVector& r, SmallVector& z) const noexcept {
  SmallVector y;
  if (!regular_) {
    right_hand_side(r, y);
    y.array() /= length_.array();
    z.noalias() = svd_.v.leftCols(rank_) * y;
    return;
  }
  if (damped_) {
    right_hand_side(r, y);
    for (int i = rank_ - 1; i >= 0; --i) {  // S y = s
      for (int k = i + 1; k < rank_; ++k) {
        y[i] -= root_[i][k] * y[k];
      }
      y[i] /= root_[i][i];
    }
  } else {
    y = r;
    qr_.solve_r_transposed(y.data());
  }
  z.resize(qr_.cols());
  qr_.lift(y.data(), z.data());
}

void RegularizedRows::null_space(SmallMatrix& V2) const noexcept {
  if (regular_) {
    qr_.null_space(V2);
  } else {
    V2 = svd_.v.rightCols(svd_.v.cols() - rank_);
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
  SmallMatrix V1;
  qr_.row_space(V1);
  K.setZero(rank_, V1.rows());
  for (int i = 0; i < rank_; ++i) {
    for (int k = i; k < rank_; ++k) {
      K.row(i) += root_[i][k] * V1.col(k).transpose();
    }
  }
}

namespace {

// By QR of M if it is tall, of its transpose if not; false if M may lack rank.
bool solve_regular(const SmallMatrix& M, const SmallVector& r, double scale, SmallVector& t) {
  const bool tall = M.rows() > M.cols();
  if (std::min(M.rows(), M.cols()) > RowQr::kMaxRows) {
    return false;
  }
  RowQr qr;
  if (tall) {
    qr.factor(M.transpose());
  } else {
    qr.factor(M);
  }
  if (!(qr.least_singular_value() > kRegularRows * scale)) {
    return false;
  }
  t.resize(M.cols());
  SmallVector y = r;
  if (tall) {
    qr.apply_q_transposed(y.data());
    qr.solve_r(y.data());
    t = y.head(M.cols());
  } else {
    qr.solve_r_transposed(y.data());
    qr.lift(y.data(), t.data());
  }
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
