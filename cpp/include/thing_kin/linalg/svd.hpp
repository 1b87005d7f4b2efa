#pragma once

#include "thing_kin/core/types.hpp"

namespace thing_kin {

/// The singular value decomposition A = U diag(sigma) V^T, [M17] (4.8).
struct Svd {
  SmallMatrix u;      ///< (m, k), k = min(m, n), orthonormal columns, also where sigma is zero
  SmallVector sigma;  ///< (k), falling, >= 0
  SmallMatrix v;      ///< (n, n), orthonormal: the first k columns belong to sigma
  int rank = 0;       ///< how many sigma exceed max(m, n) eps max(sigma_1, scale)

  auto thin_v() const { return v.leftCols(sigma.size()); }
};

/// One-sided Jacobi after a pivoted QR (Drmac & Veselic 2008): small singular values keep their
/// relative accuracy, and nothing is allocated. A must be finite, at most kMaxDof on a side.
/// `scale` says how large the entries were that A was computed from: what is left of a larger
/// matrix after a projection is noise below its rounding error, and counts as zero.
void decompose(const SmallMatrix& A, Svd& svd, double scale = 0.0) noexcept;

}  // namespace thing_kin
