#pragma once

#include "thing_kin/estimation/extended_kalman.hpp"

namespace thing_kin {

/// Points in columns: (n, 2n + 1) of the state or (m, 2n + 1) of a measurement.
using SigmaPoints = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                  kMaxState, 2 * kMaxState + 1>;

/// Scaled sigma points, [X21] 2.5: lambda = alpha^2 (n + kappa) - n.
struct UnscentedOptions {
  double alpha = 0.1;        ///< spread, above 0
  double beta = 2.0;         ///< 2 is best for Gaussians
  double kappa = 0.0;        ///< above -n; [X21] takes 3 - n
  bool square_root = false;  ///< keep a factor of P rather than P
};

/// What a function makes of a Gaussian, by its values at the sigma points.
///
/// With the points at x and x +- s L e_i, s^2 = n + lambda, and the values' differences from the
/// one at x, a_i half of what lies between two opposite ones and c_i their mean, the sums of [X21]
/// (2.6) and (2.7) are, identically,
///   mean = value at x + sum c_i / s^2
///   covariance = sum a_i a_i^T / s^2 + sum c_i c_i^T / s^2 + (beta - alpha^2) d d^T, d = mean -
///   value
/// in which nothing cancels: the weights of 1/alpha^2 and the negative one of the center are gone,
/// and what may be taken away is a rank-one term where beta < alpha^2.
struct UnscentedTransform {
  StateVector mean;
  StateVector shift;  ///< d, (m)
  StateMatrix slope;  ///< (m, n), columns a_i / s: the function's slope times L
  StateMatrix bend;   ///< (m, n), columns c_i / s: what is not linear
};

/// The unscented Kalman filter, [X21] (2.6) to (2.9), with sigma points redrawn after Q is added.
///
/// The update is the linear one in the coordinates of P's lower Cholesky factor L, where P is the
/// identity and the measurement's matrix is the slope: in Joseph's form, and equal to (2.8). Models
/// of one's own are evaluated by the caller at sigma_points(). Errors and allocation as in
/// KalmanFilter; kNotPositive where a down-date fails.
class UnscentedKalmanFilter : public GaussianFilter {
 public:
  /// Throws InvalidArgument naming x, P, alpha, beta or kappa.
  UnscentedKalmanFilter(const VectorView& x, const MatrixView& P, const UnscentedOptions& options,
                        const AngleSet& angles = {});

  const UnscentedOptions& options() const noexcept { return options_; }
  // The factor goes with it.
  // NOLINTNEXTLINE(bugprone-derived-method-shadowing-base-method)
  void set_P(const MatrixView& P);

  /// X <- the points of the present state; false, which no public function leads to, if P has no
  /// factor.
  bool sigma_points(SigmaPoints& X) noexcept;

  /// Y are the points moved.
  FilterStatus predict(const SigmaPoints& Y, const StateMatrix& Q);
  FilterStatus predict(const MotionModel& model, double dt, const StateMatrix* Q = nullptr);

  /// Z is what is expected at the points.
  FilterStatus update(const StateVector& z, const SigmaPoints& Z, const StateMatrix& R,
                      const UpdateOptions& options = {});
  FilterStatus update(const StateVector& z, const MeasurementModel& model, const StateMatrix& R,
                      double gate = 1.0);

 private:
  void transform(const SigmaPoints& Y, const AngleSet& angles,
                 UnscentedTransform& out) const noexcept;
  FilterStatus predict_moved(const SigmaPoints& Y, const double* noise) noexcept;
  FilterStatus update_seen(const StateVector& z, const SigmaPoints& Z, const double* noise,
                           double bound, const AngleSet& angles) noexcept;
  bool factor() noexcept;
  FilterStatus predict_sums(const UnscentedTransform& moved, const double* Q) noexcept;
  FilterStatus predict_root(const UnscentedTransform& moved, const double* Q) noexcept;
  FilterStatus update_sums(const UnscentedTransform& seen, const double* residual, const double* R,
                           double bound) noexcept;
  FilterStatus update_root(const UnscentedTransform& seen, const double* residual, const double* R,
                           double bound) noexcept;
  void linearized_noise(const UnscentedTransform& moved, StateMatrix& noise) const noexcept;
  void note_slope(const UnscentedTransform& moved, const StateMatrix& L, const double* Q) noexcept;
  double downdate_weight() const noexcept {
    return options_.beta - options_.alpha * options_.alpha;
  }

  UnscentedOptions options_;
  double scale_;           // s
  StateMatrix L_;          // the factor that the last sigma points were drawn with
  bool factored_ = false;  // L_ is of the present P
};

}  // namespace thing_kin
