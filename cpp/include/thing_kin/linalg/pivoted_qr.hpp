#pragma once

#include <array>

#include "thing_kin/core/types.hpp"

namespace thing_kin {

/// W P = Q R of a tall (r, k) matrix, r >= k, by Householder reflections with column pivoting.
/// Small and free of allocation: the first step of both Svd and MinimumNorm.
class PivotedQr {
 public:
  /// W, its entries of moderate size, is overwritten: its upper triangle becomes R.
  void factor(SmallMatrix& W) noexcept;

  /// Column j of R came from column pivot(j) of W.
  Eigen::Index pivot(Eigen::Index j) const { return pivots_[static_cast<std::size_t>(j)]; }

  /// x <- Q x, x of r entries.
  void apply_q(double* x) const;

 private:
  void reflect(Eigen::Index j, double* x) const;

  Eigen::Index rows_ = 0;
  Eigen::Index cols_ = 0;
  SmallMatrix reflectors_;
  std::array<double, kMaxDof> betas_;
  std::array<Eigen::Index, kMaxDof> pivots_;
};

}  // namespace thing_kin
