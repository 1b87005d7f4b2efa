#include "thing_kin/linalg/svd.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "thing_kin/core/tolerance.hpp"
#include "thing_kin/linalg/pivoted_qr.hpp"

namespace thing_kin {

namespace {

constexpr int kMaxSweeps = 40;

// Squared cosine below which two columns count as orthogonal: a few roundings.
constexpr double kOrthogonal = 16 * kEpsilon * kEpsilon;

// Below this the squares that the sweeps compare have underflowed (entries are scaled to 1).
constexpr double kNegligible = 1e-140;

/// Columns of a (k, k) matrix as vectors of a size that the compiler knows, for the common k.
template <int K>
using Column = Eigen::Map<Eigen::Matrix<double, K, 1, Eigen::ColMajor, (K > 0 ? K : kMaxDof), 1>>;

template <int K>
void rotate(Column<K> a, Column<K> b, double c, double s) {
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    const double x = a[i];
    const double y = b[i];
    a[i] = c * x - s * y;
    b[i] = s * x + c * y;
  }
}

// One-sided Jacobi: on return the columns of L V, stored in L, are orthogonal to rounding. The
// squared norms are computed anew for each sweep and only kept up to date within it.
template <int K>
void orthogonalize_columns(SmallMatrix& L, SmallMatrix& V) {
  const Eigen::Index k = L.cols();
  V.setIdentity(k, k);
  const auto column = [k](SmallMatrix& m, Eigen::Index j) { return Column<K>(&m(0, j), k); };
  std::array<double, kMaxDof> squares;
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    for (Eigen::Index j = 0; j < k; ++j) {
      squares[static_cast<std::size_t>(j)] = column(L, j).squaredNorm();
    }
    bool done = true;
    for (Eigen::Index p = 0; p + 1 < k; ++p) {
      double& aa = squares[static_cast<std::size_t>(p)];
      for (Eigen::Index q = p + 1; q < k; ++q) {
        double& bb = squares[static_cast<std::size_t>(q)];
        const double ab = column(L, p).dot(column(L, q));
        if (ab * ab <= kOrthogonal * aa * bb) {
          continue;
        }
        done = false;
        const double zeta = (bb - aa) / (2.0 * ab);
        const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::sqrt(1.0 + zeta * zeta));
        const double c = 1.0 / std::sqrt(1.0 + t * t);
        rotate<K>(column(L, p), column(L, q), c, c * t);
        rotate<K>(column(V, p), column(V, q), c, c * t);
        aa = std::max(0.0, aa - t * ab);
        bb += t * ab;
      }
    }
    if (done) {
      return;
    }
  }
}

// Fills column j of U with a unit vector orthogonal to the columns before it: the coordinate axis
// that sticks out of them most, projected twice.
void complete_column(SmallMatrix& U, Eigen::Index j) {
  Eigen::Index axis = 0;
  double least = 2.0;  // more than the squared norm of any row of an orthonormal matrix
  for (Eigen::Index row = 0; row < U.rows(); ++row) {
    const double square = U.row(row).head(j).squaredNorm();
    if (square < least) {
      least = square;
      axis = row;
    }
  }
  SmallVector unit = SmallVector::Unit(U.rows(), axis);
  for (int pass = 0; pass < 2; ++pass) {
    for (Eigen::Index c = 0; c < j; ++c) {
      unit -= U.col(c).dot(unit) * U.col(c);
    }
    unit.normalize();
  }
  U.col(j) = unit;
}

// Splits the orthogonal columns of L into U diag(sigma), falling; order[j]: which column was taken.
void split(const SmallMatrix& L, SmallMatrix& U, SmallVector& sigma,
           std::array<Eigen::Index, kMaxDof>& order) {
  const Eigen::Index k = L.cols();
  SmallVector norms(k);
  for (Eigen::Index j = 0; j < k; ++j) {
    norms[j] = L.col(j).norm();
    Eigen::Index place = j;  // insertion sort: stable, and k is small
    for (; place > 0 && norms[order[static_cast<std::size_t>(place - 1)]] < norms[j]; --place) {
      order[static_cast<std::size_t>(place)] = order[static_cast<std::size_t>(place - 1)];
    }
    order[static_cast<std::size_t>(place)] = j;
  }
  U.resize(k, k);
  sigma.resize(k);
  for (Eigen::Index j = 0; j < k; ++j) {
    const Eigen::Index from = order[static_cast<std::size_t>(j)];
    if (norms[from] > kNegligible) {
      sigma[j] = norms[from];
      U.col(j) = L.col(from) / norms[from];
    } else {
      sigma[j] = 0.0;
      complete_column(U, j);
    }
  }
}

void orthogonalize_columns(SmallMatrix& L, SmallMatrix& V) {
  switch (L.cols()) {
    case 2:
      return orthogonalize_columns<2>(L, V);
    case 3:
      return orthogonalize_columns<3>(L, V);
    case 6:
      return orthogonalize_columns<6>(L, V);
    default:
      return orthogonalize_columns<Eigen::Dynamic>(L, V);
  }
}

void set_zero_decomposition(Eigen::Index m, Eigen::Index n, Svd& svd) {
  svd.u.setIdentity(m, std::min(m, n));
  svd.sigma.setZero(std::min(m, n));
  svd.v.setIdentity(n, n);
  svd.rank = 0;
}

}  // namespace

void decompose(const SmallMatrix& A, Svd& svd, double scale) noexcept {
  const Eigen::Index m = A.rows();
  const Eigen::Index n = A.cols();
  const Eigen::Index k = std::min(m, n);
  const double unit = A.size() > 0 ? A.cwiseAbs().maxCoeff() : 0.0;
  if (unit == 0.0) {
    set_zero_decomposition(m, n, svd);
    return;
  }
  // W P = Q R, and R^T V' = U' Sigma by Jacobi, so that W = (Q V') Sigma (P U')^T.
  const bool wide = m <= n;
  SmallMatrix W;
  if (wide) {
    W = A.transpose() / unit;
  } else {
    W = A / unit;
  }
  PivotedQr qr;
  qr.factor(W);
  SmallMatrix L = W.topRows(k).triangularView<Eigen::Upper>().transpose();
  SmallMatrix rotations;
  orthogonalize_columns(L, rotations);
  SmallMatrix U;
  std::array<Eigen::Index, kMaxDof> order;
  split(L, U, svd.sigma, order);

  SmallMatrix& short_side = wide ? svd.u : svd.v;  // P U'
  short_side.resize(k, k);
  for (Eigen::Index row = 0; row < k; ++row) {
    short_side.row(qr.pivot(row)) = U.row(row);
  }
  SmallMatrix& long_side = wide ? svd.v : svd.u;  // Q V', completed to a basis if it is V
  const Eigen::Index r = W.rows();
  long_side.setZero(r, wide ? r : k);
  for (Eigen::Index j = 0; j < long_side.cols(); ++j) {
    if (j < k) {
      long_side.col(j).head(k) = rotations.col(order[static_cast<std::size_t>(j)]);
    } else {
      long_side(j, j) = 1.0;
    }
    qr.apply_q(&long_side(0, j));
  }
  svd.sigma *= unit;
  const double tolerance = rank_tolerance(m, n) * std::max(svd.sigma[0], scale);
  svd.rank = static_cast<int>((svd.sigma.array() > tolerance).count());
}

}  // namespace thing_kin
