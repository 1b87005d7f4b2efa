#pragma once

#include "thing_kin/linalg/row_qr.hpp"
#include "thing_kin/linalg/singular_value_filter.hpp"
#include "thing_kin/linalg/svd.hpp"

namespace thing_kin {

/// How a level of a hierarchy is regularized: damped, [M17] (4.7), filtered, (4.12), or neither.
struct Regularization {
  double damping = 0.0;
  const SingularValueFilter* filter = nullptr;
};

/// The rows of M z = r as one level of a hierarchy. M = L V1^T with [V1 V2] orthonormal: the level
/// is about y = V1^T z only, minimizes |L y - r|^2 + damping |y|^2 with filtered singular values of
/// L, and leaves exactly the span of V2 free, whatever the regularization.
class RegularizedRows {
 public:
  /// `scale`: how large the entries were that M was computed from, see decompose().
  void factor(const SmallMatrix& M, double scale, const Regularization& regularization) noexcept;

  int rank() const { return rank_; }

  /// The smallest minimizer V1 y.
  void solve(const SmallVector& r, SmallVector& z) const noexcept;

  /// V2, (f, f - rank).
  void null_space(SmallMatrix& V2) const noexcept;

  /// K of full row rank and s so that minimizing |K z - s|^2 is the level, for the M of factor().
  void square_root(const SmallMatrix& M, const SmallVector& r, SmallMatrix& K,
                   SmallVector& s) const noexcept;

 private:
  void right_hand_side(const SmallVector& r, SmallVector& s) const noexcept;

  bool regular_ = false;  // by QR: L = R^T; else by singular values: L = U Sigma
  bool damped_ = false;
  int rank_ = 0;
  RowQr qr_;
  double root_[RowQr::kMaxRows][RowQr::kMaxRows];  // S, upper triangular: S^T S = R R^T + damping
  Svd svd_;
  SmallVector lifted_;  // singular values after the filter
  SmallVector length_;  // sqrt(lifted^2 + damping), the rows of K
};

/// The minimum-norm least-squares solution of M t = r, by QR where M is clearly regular.
void least_squares(const SmallMatrix& M, const SmallVector& r, double scale,
                   SmallVector& t) noexcept;

}  // namespace thing_kin
