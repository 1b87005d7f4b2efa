#pragma once

#include "thing_kin/kinematics/jacobian.hpp"

namespace thing_kin {

/// M = blockdiag(linear, angular), which turns a Jacobian into that of another error. Columns are
/// padded to four numbers.
struct RowFactors {
  alignas(32) std::array<double, 12> linear{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  alignas(32) std::array<double, 12> angular{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

  void set(const Eigen::Matrix3d& of_linear, const Eigen::Matrix3d& of_angular) noexcept;

  RowFactors transposed() const noexcept;

  /// M c, for a column of the Jacobian.
  Vector6 operator*(const Vector6& c) const noexcept;
};

/// The damped inverse in its form with a 6 x 6 matrix, [M17] (4.7), with weights: of the dq that
/// least squares |M J dq - e|^2 + lambda dq^T W dq asks for,
///
///     dq = W^-1 (M J)^T (M J W^-1 (M J)^T + lambda I)^-1 e.
///
/// mobility: the diagonal of W^-1, n numbers >= 0; 0 keeps a joint still. lambda > 0, and so large
/// that it is not lost beside the matrix. dq: n numbers.
void damped_inverse(const Jacobian& J, const RowFactors& M, const double* mobility, double lambda,
                    const Vector6& e, double* dq) noexcept;

}  // namespace thing_kin
