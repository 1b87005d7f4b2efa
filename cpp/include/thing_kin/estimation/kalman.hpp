#pragma once

#include "thing_kin/estimation/gaussian_filter.hpp"

namespace thing_kin {

/// How a measurement is taken.
struct UpdateOptions {
  double gate = 1.0;  ///< a probability: an update whose NIS exceeds its quantile is rejected
  AngleSet angles;    ///< of the measurement
};

/// The linear Kalman filter, [X21] (2.3) to (2.5). (2.4) misprints the gain, K = P H^T S^-1.
///
/// The functions throw InvalidArgument, naming it, for what is wrong with an argument; then, and
/// where the status is not kOk, nothing has changed. They do not allocate.
class KalmanFilter : public GaussianFilter {
 public:
  using GaussianFilter::GaussianFilter;

  /// x <- F x + offset, P <- F P F^T + Q; offset, (n), is B u or empty.
  FilterStatus predict(const ModelMatrix& F, const StateMatrix& Q, const StateVector& offset = {});

  FilterStatus update(const StateVector& z, const ModelMatrix& H, const StateMatrix& R,
                      const UpdateOptions& options = {});
};

}  // namespace thing_kin
