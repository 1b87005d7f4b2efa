#pragma once

#include "thing_kin/core/types.hpp"

namespace thing_kin {

/// A^T = Q R of a wide (m, f) matrix of at most kMaxRows rows, by Householder reflections without
/// pivoting, and how far from singular A is at least. Columns are padded to a length that the
/// compiler knows: for matrices this small that is most of the speed.
class RowQr {
 public:
  static constexpr int kMaxRows = 8;

  /// A has at most kMaxRows rows and no more rows than columns; its entries' squares are finite.
  void factor(const SmallMatrix& A) noexcept;

  /// 1/|R^-1|, at most the smallest singular value of A: zero if A may be singular.
  double least_singular_value() const { return least_; }

  int rows() const { return m_; }
  int cols() const { return f_; }

  /// R(i, j), i <= j.
  double r(int i, int j) const { return r_[j][i]; }

  /// y <- R^-1 y, y <- R^-T y, of m entries; only where A is regular.
  void solve_r(double* y) const noexcept;
  void solve_r_transposed(double* y) const noexcept;

  /// x <- Q [y; 0], x of f entries and y of m.
  void lift(const double* y, double* x) const noexcept;

  /// x <- Q^T x, of f entries.
  void apply_q_transposed(double* x) const noexcept;

  /// The first m columns of Q, (f, m), and the others, (f, f - m): the null space of A.
  void row_space(SmallMatrix& V1) const noexcept;
  void null_space(SmallMatrix& V2) const noexcept;

 private:
  template <int Length>
  void reflect_rows() noexcept;
  void invert_r() noexcept;
  void columns_of_q(int first, int count, SmallMatrix& V) const noexcept;

  int m_ = 0;
  int f_ = 0;
  double least_ = 0.0;
  double beta_[kMaxRows];
  double r_[kMaxRows][kMaxRows];        // columns
  double inverse_[kMaxRows][kMaxRows];  // of R, columns
  alignas(64) double v_[kMaxRows][kMaxDof];
};

}  // namespace thing_kin
