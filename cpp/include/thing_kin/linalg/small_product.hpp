#pragma once

#include "thing_kin/core/types.hpp"

namespace thing_kin {

/// C <- A B, column by column. For sizes of a robot's joints, where Eigen would block the product
/// for a cache that holds it a hundred times over. C must be neither A nor B.
template <typename Left, typename Right>
void multiply(const Left& A, const Right& B, SmallMatrix& C) noexcept {
  C.resize(A.rows(), B.cols());
  for (Eigen::Index j = 0; j < B.cols(); ++j) {
    double* column = &C.coeffRef(0, j);
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      column[i] = 0.0;
    }
    for (Eigen::Index k = 0; k < A.cols(); ++k) {
      const double factor = B(k, j);
      if (factor == 0.0) {
        continue;
      }
      for (Eigen::Index i = 0; i < A.rows(); ++i) {
        column[i] += A(i, k) * factor;
      }
    }
  }
}

/// y <- y + sign A x.
template <typename Left>
void accumulate(double sign, const Left& A, const SmallVector& x, SmallVector& y) noexcept {
  for (Eigen::Index k = 0; k < A.cols(); ++k) {
    const double factor = sign * x[k];
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      y[i] += A(i, k) * factor;
    }
  }
}

}  // namespace thing_kin
