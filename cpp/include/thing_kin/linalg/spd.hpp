#pragma once

#include <string>

#include "thing_kin/core/types.hpp"

// Symmetric positive (semi)definite matrices, in one place: covariances are checked, kept
// symmetric and kept positive here, and nowhere else. A variance of exactly zero is a number that
// is known: its row and column must be zero, and stay so.

namespace thing_kin {

/// A view to write to.
using MatrixSpan = Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using VectorSpan = Eigen::Ref<Eigen::VectorXd>;

/// How far a given covariance may be from symmetric and from positive semidefinite, relative to its
/// standard deviations: loose enough for single precision, tight enough to refuse anything else.
inline constexpr double kCovarianceTolerance = 1e-6;

/// What rounding may take from a covariance's eigenvalues, relative to its variances: more is not
/// rounding.
inline constexpr double kMostInflation = 1e-6;

/// Throws InvalidArgument that begins with `name` unless A is n by n, finite, symmetric and
/// positive semidefinite within kCovarianceTolerance.
void check_covariance(const MatrixView& A, Eigen::Index n, const std::string& name);

/// A <- (A + A^T)/2
void symmetrize(MatrixSpan A) noexcept;

/// Whether A's pivots, relative to its diagonal, are clear of rounding: then any Cholesky
/// factorization of it succeeds. Reads one triangle. False for NaN.
bool is_positive(const MatrixView& A) noexcept;

/// Where rounding took positivity from a symmetric A, variances grow by the least sufficient
/// fraction, in powers of four from the rounding error on. False, and A is as it was, where
/// `most` would not do.
bool keep_positive(MatrixSpan A, double most = kMostInflation) noexcept;

/// The same for an A that is a sum in which much may have cancelled, its variances too: they grow
/// by a fraction of `sizes`, (n), what the sum of the terms' sizes is. Always possible for finite
/// numbers and sizes > 0.
bool keep_positive(MatrixSpan A, const VectorView& sizes) noexcept;

/// L <- the lower Cholesky factor of A, L L^T = A; L may be A. False, and L is anything, unless A
/// is positive (semi)definite: a pivot of rounding size, or less, is refused unless its variance is
/// 0.
bool cholesky(const MatrixView& A, MatrixSpan L) noexcept;

/// W (n, k) in rows, k >= n: its first n columns <- lower triangular L with a diagonal >= 0 and
/// L L^T = W W^T, the others <- 0. What a square-root filter does instead of adding covariances.
void lower_factor(double* W, int n, int k) noexcept;

/// The lower Cholesky factor of L L^T + weight v v^T, in place; a negative weight takes away.
/// False, and L is as it was, where positivity would be lost.
bool cholesky_update(MatrixSpan L, const VectorView& v, double weight) noexcept;

}  // namespace thing_kin
