#include "thing_kin/linalg/singular_basis.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "thing_kin/core/tolerance.hpp"

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Column = Eigen::Map<VectorXd>;

constexpr int kMostSweeps = 60;
constexpr double kOrthogonalCosine = 4 * kEpsilon;
constexpr double kUnderflows = 1e-140;  // when squared, of entries that are scaled to 1

// The reflection that leaves of v its first entry alone, applied to the columns `from` on.
void reflect(MatrixXd& A, Index j, Index from, const VectorXd& v) {
  const Index below = A.rows() - j;
  const double beta = 2.0 / v.squaredNorm();
  for (Index c = from; c < A.cols(); ++c) {
    Column rest(&A(j, c), below);
    const double factor = -beta * v.dot(rest);
    rest += factor * v;
  }
}

// Column j below the diagonal <- 0, by a reflection of all that is right of it.
void eliminate(MatrixXd& A, Index j) {
  VectorXd v = A.col(j).tail(A.rows() - j);
  const double diagonal = -std::copysign(v.norm(), v[0]);
  v[0] -= diagonal;
  if (std::abs(diagonal) > kUnderflows) {
    reflect(A, j, j + 1, v);
  }
  A(j, j) = diagonal;
}

// A = Q R: R alone, without pivots, which would cost as much again.
MatrixXd triangle(MatrixXd A) {
  for (Index j = 0; j < A.cols(); ++j) {
    eliminate(A, j);
  }
  return A.topRows(A.cols()).triangularView<Eigen::Upper>();
}

// A P = Q R in place, of R alone; returns P.
std::vector<Index> pivoted_triangle(MatrixXd& A) {
  std::vector<Index> pivots(static_cast<std::size_t>(A.cols()));
  std::iota(pivots.begin(), pivots.end(), 0);
  for (Index j = 0; j < std::min(A.rows(), A.cols()); ++j) {
    Index best = j;
    double most = -1.0;
    for (Index c = j; c < A.cols(); ++c) {
      const double square = A.col(c).tail(A.rows() - j).squaredNorm();
      best = square > most ? c : best;
      most = std::max(square, most);
    }
    A.col(j).swap(A.col(best));
    std::swap(pivots[static_cast<std::size_t>(j)], pivots[static_cast<std::size_t>(best)]);
    eliminate(A, j);
  }
  return pivots;
}

void rotate(Column a, Column b, double tangent) {
  const double c = 1.0 / std::sqrt(1.0 + tangent * tangent);
  const double s = c * tangent;
  for (Index i = 0; i < a.size(); ++i) {
    const double x = a[i];
    const double y = b[i];
    a[i] = c * x - s * y;
    b[i] = s * x + c * y;
  }
}

// One sweep of Jacobi's; false where all columns were orthogonal.
bool sweep(MatrixXd& L, VectorXd& squares) {
  bool any = false;
  squares = L.colwise().squaredNorm();
  for (Index p = 0; p + 1 < L.cols(); ++p) {
    for (Index q = p + 1; q < L.cols(); ++q) {
      const Column a(&L(0, p), L.rows());
      const Column b(&L(0, q), L.rows());
      const double product = a.dot(b);
      if (std::abs(product) <= kOrthogonalCosine * std::sqrt(squares[p]) * std::sqrt(squares[q])) {
        continue;
      }
      any = true;
      const double zeta = (squares[q] - squares[p]) / (2.0 * product);
      const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::sqrt(1.0 + zeta * zeta));
      rotate(a, b, t);
      squares[p] = std::max(0.0, squares[p] - t * product);
      squares[q] += t * product;
    }
  }
  return any;
}

// A unit vector orthogonal to the first `count` columns: the coordinate axis that sticks out of
// them most, projected twice.
VectorXd another_column(const MatrixXd& V, Index count) {
  Index axis = 0;
  V.leftCols(count).rowwise().squaredNorm().minCoeff(&axis);
  VectorXd unit = VectorXd::Unit(V.rows(), axis);
  for (int pass = 0; pass < 2; ++pass) {
    for (Index c = 0; c < count; ++c) {
      unit -= V.col(c).dot(unit) * V.col(c);
    }
    unit.normalize();
  }
  return unit;
}

}  // namespace

SingularBasis singular_basis(MatrixXd A) {
  const Index n = A.cols();
  SingularBasis basis{VectorXd::Zero(n), MatrixXd::Identity(n, n)};
  const double unit = A.size() > 0 ? A.cwiseAbs().maxCoeff() : 0.0;
  if (unit == 0.0) {
    return basis;
  }
  A /= unit;
  if (A.rows() > n) {
    A = triangle(std::move(A));
  }
  const std::vector<Index> pivots = pivoted_triangle(A);
  // R^T V' = U' diag(sigma), so that A = (Q V') diag(sigma) (P U')^T.
  MatrixXd L = MatrixXd::Zero(n, n);
  for (Index row = 0; row < std::min(A.rows(), n); ++row) {
    L.col(row).tail(n - row) = A.row(row).tail(n - row).transpose();
  }
  VectorXd squares(n);
  for (int i = 0; i < kMostSweeps && sweep(L, squares); ++i) {
  }
  const VectorXd norms = L.colwise().norm();
  std::vector<Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](Index a, Index b) { return norms[a] > norms[b]; });
  MatrixXd U(n, n);
  for (Index j = 0; j < n; ++j) {
    const Index from = order[static_cast<std::size_t>(j)];
    const bool is_zero = norms[from] <= kUnderflows;
    basis.sigma[j] = is_zero ? 0.0 : norms[from] * unit;
    U.col(j) = is_zero ? another_column(U, j) : VectorXd(L.col(from) / norms[from]);
  }
  for (Index row = 0; row < n; ++row) {
    basis.v.row(pivots[static_cast<std::size_t>(row)]) = U.row(row);
  }
  return basis;
}

}  // namespace thing_kin
