#pragma once

#include "thing_kin/linalg/pivoted_qr.hpp"

namespace thing_kin {

/// The minimum-norm solution A^+ e and the null space of a wide matrix of clearly full rank, by a
/// QR factorization: a few times faster than by singular values, and equal to rounding.
class MinimumNorm {
 public:
  /// False if A is not wide, has many rows or may lack rank: then only the singular values tell.
  /// `scale`: how large the entries were that A was computed from, see decompose().
  bool factor(const SmallMatrix& A, double scale = 0.0) noexcept;

  /// A^+ e, (n).
  JointVector solve(const SmallVector& e) const noexcept;

  /// A^+, (n, m).
  SmallMatrix pseudoinverse() const noexcept;

  /// Orthonormal basis of the null space of A, (n, n - m).
  SmallMatrix null_space() const noexcept;

 private:
  // x <- Q [R^-T P^T e; 0].
  void solve(const double* e, double* x) const noexcept;

  double unit_ = 1.0;    // what A is divided by
  SmallMatrix factors_;  // R in the upper triangle
  PivotedQr qr_;
};

}  // namespace thing_kin
