#pragma once

#include "thing_kin/linalg/svd.hpp"

namespace thing_kin {

/// Gains g_i of the inverse V diag(g) U^T.
/// Exact (Moore-Penrose), [M17] (4.9): 1/sigma, and 0 for singular values beyond the rank.
SmallVector exact_gains(const Svd& svd) noexcept;

/// Damped, [M17] (4.10): sigma/(sigma^2 + lambda); where lambda is zero, exact.
SmallVector damped_gains(const Svd& svd, double lambda) noexcept;

/// Selectively damped in matrix form, [M17] (4.11): a lambda_i for each singular value.
SmallVector damped_gains(const Svd& svd, const SmallVector& lambda) noexcept;

/// A^+, (n, m), and A^+ e, (n): by QR where A is clearly regular (MinimumNorm), else by singular
/// values.
SmallMatrix exact_pseudoinverse(const SmallMatrix& A) noexcept;
JointVector minimum_norm_solution(const SmallMatrix& A, const SmallVector& e) noexcept;

/// V diag(gains) U^T, (n, m).
SmallMatrix pseudoinverse(const Svd& svd, const SmallVector& gains) noexcept;

/// V diag(gains) U^T e without forming the matrix, (n).
JointVector apply_pseudoinverse(const Svd& svd, const SmallVector& gains,
                                const SmallVector& e) noexcept;

}  // namespace thing_kin
