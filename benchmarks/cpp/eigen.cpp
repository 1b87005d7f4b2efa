// The pseudoinverse that an Eigen user writes: sizes known, no allocation.

#include <Eigen/QR>
#include <Eigen/SVD>

#include "problem.hpp"

namespace {

using bench::Matrix69;
using Matrix96 = Eigen::Matrix<double, 9, 6>;

Matrix96 by_svd(const bench::Problem::Input& input) {
  // Eigen 3.4 has thin factors for matrices of dynamic size only; bounded, it does not allocate.
  constexpr auto kThin = Eigen::ComputeThinU | Eigen::ComputeThinV;
  const Eigen::JacobiSVD<Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 9>> svd(input.jacobian,
                                                                                kThin);
  return svd.matrixV() * svd.singularValues().cwiseInverse().asDiagonal() *
         svd.matrixU().transpose();
}

Matrix96 by_orthogonal_decomposition(const bench::Problem::Input& input) {
  return Eigen::CompleteOrthogonalDecomposition<Matrix69>(input.jacobian).pseudoInverse();
}

[[maybe_unused]] const bool entered =
    bench::enter("pinv_6x9", "eigen_svd", by_svd, bench::as_it_is) &&
    bench::enter("pinv_6x9", "eigen_cod", by_orthogonal_decomposition, bench::as_it_is);

}  // namespace
