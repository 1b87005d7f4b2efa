#pragma once

#include <array>

#include "thing_kin/core/types.hpp"

namespace thing_kin {

/// W P = Q R of a tall (r, k) matrix, r >= k, by Householder reflections with column pivoting.
/// Small and free of allocation: for the singular value decomposition only.
class PivotedQr {
 public:
  /// W is overwritten: its upper triangle becomes R.
  explicit PivotedQr(SmallMatrix& W);

  /// Column j of R came from column pivot(j) of W.
  Eigen::Index pivot(Eigen::Index j) const { return pivots_[static_cast<std::size_t>(j)]; }

  /// x <- Q x, x of r entries.
  void apply_q(double* x) const;

 private:
  void reflect(Eigen::Index j, double* x) const;

  Eigen::Index rows_;
  Eigen::Index cols_;
  SmallMatrix reflectors_;
  std::array<double, kMaxDof> betas_;
  std::array<Eigen::Index, kMaxDof> pivots_;
};

}  // namespace thing_kin
