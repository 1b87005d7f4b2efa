#pragma once

#include "thing_kin/estimation/gaussian_filter.hpp"

// The two steps that Kalman and extended Kalman filters are made of, [X21] (2.3) to (2.5), [M17]
// (3.24) and (3.25). Arrays are bare and of the sizes said; covariances must have been checked.

namespace thing_kin {

/// x <- fx, P <- F P F^T + Q: fx (n), F (n, n) in rows, Q (n, n).
FilterStatus predict_linear(Gaussian& state, const double* fx, const double* F,
                            const double* Q) noexcept;

/// A measurement of m rows, seen linearly.
struct LinearMeasurement {
  int rows = 0;
  const double* residual = nullptr;  ///< (m), z minus what is expected
  const double* H = nullptr;         ///< (m, n) in rows
  const double* R = nullptr;         ///< (m, m)
};

/// The update in Joseph's form, P <- (I - K H) P (I - K H)^T + K R K^T, which adds what is
/// positive. Rejected where the NIS exceeds `bound`. `update` is written in any case but kSingular.
FilterStatus update_linear(Gaussian& state, const LinearMeasurement& measurement, double bound,
                           FilterUpdate& update) noexcept;

}  // namespace thing_kin
