#include "thing_kin/estimation/calibration_leverage.hpp"

#include <cmath>

#include "thing_kin/linalg/spd.hpp"
#include "thing_kin/linalg/svd.hpp"

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRoundingPivot = 1e-14;  // of a matrix with a unit diagonal
constexpr double kTakenWhole = 0.01;      // of a residual's variance is left

// L with L L^T = N, of a diagonal of ones; rows of what rounding has left are infinitely long, so
// that their solution is zero.
RowMajorMatrix semidefinite_root(const MatrixXd& N) {
  RowMajorMatrix L = N;
  for (Index j = 0; j < N.rows(); ++j) {
    for (Index i = j; i < N.rows(); ++i) {
      L(i, j) -= L.row(i).head(j).dot(L.row(j).head(j));
    }
    const double pivot = L(j, j);
    const double inverse = pivot > kRoundingPivot ? 1.0 / std::sqrt(pivot) : 0.0;
    L.col(j).tail(N.rows() - j) *= inverse;
    L(j, j) = inverse;  // its inverse: that is what solving takes
  }
  return L;
}

}  // namespace

CalibrationLeverage::CalibrationLeverage(const RowMajorMatrix& J,
                                         std::span<const CalibrationParameter> parameters) {
  const Index p = J.cols();
  MatrixXd N(p, p);
  N.noalias() = J.transpose() * J;
  for (Index i = 0; i < p; ++i) {
    const double deviation = parameters[static_cast<std::size_t>(i)].deviation;
    N(i, i) += 1.0 / (deviation * deviation);
  }
  const VectorXd scale = N.diagonal().cwiseSqrt().cwiseInverse();
  N = scale.asDiagonal() * N * scale.asDiagonal();
  const RowMajorMatrix L = semidefinite_root(N);
  root_.resize(p, J.rows());
  for (Index row = 0; row < J.rows(); ++row) {
    auto x = root_.col(row);
    for (Index i = 0; i < p; ++i) {
      x[i] = L(i, i) * (scale[i] * J(row, i) - L.row(i).head(i).dot(x.head(i)));
    }
  }
}

VectorXd CalibrationLeverage::shares() const { return root_.colwise().squaredNorm(); }

double CalibrationLeverage::square_of_rest(Index row, const VectorXd& r) const {
  const Index m = r.size();
  const auto columns = root_.middleCols(row, m);
  const SmallMatrix own = SmallMatrix::Identity(m, m) - columns.transpose().lazyProduct(columns);
  SmallMatrix L = own - kTakenWhole * SmallMatrix::Identity(m, m);
  double square = 0.0;
  if (cholesky(L, L) && cholesky(own, L)) {
    VectorXd x = r;
    for (Index i = 0; i < m; ++i) {
      x[i] = (r[i] - L.row(i).head(i).dot(x.head(i))) / L(i, i);
    }
    return x.squaredNorm();
  }
  Svd svd;  // of a symmetric matrix, not negative: its eigenvectors
  decompose(own, svd);
  for (Index i = 0; i < m; ++i) {
    const double along = svd.u.col(i).dot(r);
    square += svd.sigma[i] > kTakenWhole ? along * along / svd.sigma[i] : 0.0;
  }
  return square;
}

}  // namespace thing_kin
