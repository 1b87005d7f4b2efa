#include "thing_kin/linalg/pivoted_qr.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace thing_kin {

namespace {

// Entries are scaled to at most 1: what is smaller than this underflows when squared.
constexpr double kTinySquare = 1e-300;

double square_norm(const double* x, Eigen::Index n) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    sum += x[i] * x[i];
  }
  return sum;
}

}  // namespace

void PivotedQr::factor(SmallMatrix& W) noexcept {
  rows_ = W.rows();
  cols_ = W.cols();
  reflectors_.resize(rows_, cols_);
  for (Eigen::Index j = 0; j < cols_; ++j) {
    pivots_[static_cast<std::size_t>(j)] = j;
  }
  for (Eigen::Index j = 0; j < cols_; ++j) {
    const Eigen::Index below = rows_ - j;
    Eigen::Index best = j;
    double square = -1.0;
    for (Eigen::Index c = j; c < cols_; ++c) {
      const double candidate = square_norm(&W(j, c), below);
      if (candidate > square) {
        square = candidate;
        best = c;
      }
    }
    if (best != j) {
      W.col(j).swap(W.col(best));
      std::swap(pivots_[static_cast<std::size_t>(j)], pivots_[static_cast<std::size_t>(best)]);
    }
    double* v = &reflectors_(j, j);
    std::copy_n(&W(j, j), below, v);
    const double diagonal = -std::copysign(std::sqrt(square), v[0]);
    v[0] -= diagonal;
    const double v_square = square - 2.0 * diagonal * (v[0] + diagonal) + diagonal * diagonal;
    betas_[static_cast<std::size_t>(j)] = v_square > kTinySquare ? 2.0 / v_square : 0.0;
    W(j, j) = diagonal;
    for (Eigen::Index c = j + 1; c < cols_; ++c) {
      reflect(j, &W(0, c));
    }
  }
}

// x <- (I - beta v v^T) x, v zero above row j.
void PivotedQr::reflect(Eigen::Index j, double* x) const {
  const double* v = &reflectors_(0, j);
  double along = 0.0;
  for (Eigen::Index i = j; i < rows_; ++i) {
    along += v[i] * x[i];
  }
  along *= betas_[static_cast<std::size_t>(j)];
  for (Eigen::Index i = j; i < rows_; ++i) {
    x[i] -= along * v[i];
  }
}

void PivotedQr::apply_q(double* x) const {
  for (Eigen::Index j = cols_ - 1; j >= 0; --j) {
    reflect(j, x);
  }
}

}  // namespace thing_kin
