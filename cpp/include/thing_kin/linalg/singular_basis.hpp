#pragma once

#include <Eigen/Core>

namespace thing_kin {

/// Half of a singular value decomposition A = U diag(sigma) V^T: of a matrix of any size, for least
/// squares of many rows.
struct SingularBasis {
  Eigen::VectorXd sigma;  ///< (n), falling, >= 0; zero beyond the number of rows
  Eigen::MatrixXd v;      ///< (n, n), orthonormal columns, also where sigma is zero
};

/// As decompose() of svd.hpp: one-sided Jacobi after a pivoted QR (Drmac & Veselic 2008), so that
/// small singular values keep their relative accuracy, where those of A^T A would lose half of the
/// digits. A must be finite.
SingularBasis singular_basis(Eigen::MatrixXd A);

}  // namespace thing_kin
