#include "thing_kin/estimation/unscented_kalman.hpp"

#include <array>
#include <cmath>

#include "thing_kin/core/error.hpp"
#include "thing_kin/core/finite.hpp"
#include "thing_kin/estimation/linear_steps.hpp"
#include "thing_kin/estimation/step_checks.hpp"
#include "thing_kin/linalg/symmetric_kernels.hpp"

namespace thing_kin {

namespace {

void check_points(const SigmaPoints& Y, Eigen::Index rows, int n, const char* name) {
  if (Y.rows() != rows || Y.cols() != 2 * n + 1) {
    throw InvalidArgument(name, "points of another size or number",
                          std::to_string(2 * n + 1) + " of " + std::to_string(rows));
  }
  if (!all_finite(Y.data(), static_cast<std::size_t>(Y.size()))) {
    throw InvalidArgument(name, "NaN or infinity", "finite numbers");
  }
}

}  // namespace

UnscentedKalmanFilter::UnscentedKalmanFilter(const VectorView& x, const MatrixView& P,
                                             const UnscentedOptions& options,
                                             const AngleSet& angles)
    : GaussianFilter(x, P, angles), options_(options) {
  if (!(std::isfinite(options.alpha) && options.alpha > 0.0)) {
    throw InvalidArgument("alpha", text(options.alpha), "a finite number above 0");
  }
  if (!std::isfinite(options.beta)) {
    throw InvalidArgument("beta", text(options.beta), "a finite number");
  }
  if (!(std::isfinite(options.kappa) && size() + options.kappa > 0.0)) {
    throw InvalidArgument("kappa", text(options.kappa),
                          "a finite number above -n, -" + std::to_string(size()));
  }
  scale_ = options.alpha * std::sqrt(size() + options.kappa);
}

void UnscentedKalmanFilter::set_P(const MatrixView& P) {
  GaussianFilter::set_P(P);
  factored_ = false;
}

bool UnscentedKalmanFilter::factor() noexcept {
  if (!factored_) {
    const int n = size();
    L_.resize(n, n);
    factored_ = kernels::with_size(
        n, [&]<int N>() { return kernels::cholesky<N>(state_.P.data(), L_.data(), n); });
  }
  return factored_;
}

bool UnscentedKalmanFilter::sigma_points(SigmaPoints& X) noexcept {
  if (!factor()) {
    return false;
  }
  const int n = size();
  X.resize(n, 2 * n + 1);
  kernels::with_size(n, [&]<int N>() {
    const int rows = kernels::size_of<N>(n);
    const kernels::Strip<N> x = kernels::strip<N>(state_.x.data(), rows);
    double* const points = X.data();
    kernels::put<N>(x, points);
    for (int k = 0; k < rows; ++k) {
      const kernels::Strip<N> way = kernels::strip<N>(L_.data() + k * rows, rows) * scale_;
      kernels::put<N>(x + way, points + (k + 1) * rows);
      kernels::put<N>(x - way, points + (rows + k + 1) * rows);
    }
  });
  return true;
}

// x' = F x + noise with F L = slope: what a smoother needs of a nonlinear prediction.
void UnscentedKalmanFilter::note_slope(const UnscentedTransform& moved, const StateMatrix& L,
                                       const double* Q) noexcept {
  if (transition_ == nullptr || status_ != FilterStatus::kOk) {
    return;
  }
  const int n = size();
  StateMatrix noise = Eigen::Map<const StateMatrix>(Q, n, n);
  linearized_noise(moved, noise);
  StateMatrix F = moved.slope;
  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < n; ++j) {
      F.col(k) -= F.col(j) * L(j, k);
    }
    F.col(k) *= L(k, k) > 0.0 ? 1.0 / L(k, k) : 0.0;
  }
  const ModelMatrix rows = F;
  note_transition(rows.data(), noise.data());
}

FilterStatus UnscentedKalmanFilter::predict(const SigmaPoints& Y, const StateMatrix& Q) {
  const int n = size();
  check_points(Y, n, n, "f(x)");
  check_square(Q, n, "Q");
  const double* noise = known_Q_(Q.data(), n, "Q");
  return factor() ? predict_moved(Y, noise) : done(FilterStatus::kNotPositive);
}

FilterStatus UnscentedKalmanFilter::predict_moved(const SigmaPoints& Y,
                                                  const double* noise) noexcept {
  UnscentedTransform moved;
  transform(Y, state_.angles, moved);
  const StateMatrix drawn_with = transition_ != nullptr ? L_ : StateMatrix();
  done(options_.square_root ? predict_root(moved, noise) : predict_sums(moved, noise));
  note_slope(moved, drawn_with, noise);
  factored_ = factored_ && (status_ != FilterStatus::kOk || options_.square_root);
  return status_;
}

FilterStatus UnscentedKalmanFilter::predict(const MotionModel& model, double dt,
                                            const StateMatrix* Q) {
  const int n = size();
  check_model(model, dt, n, state_.angles);
  StateMatrix own;
  const double* noise = own.data();
  if (Q != nullptr) {
    check_square(*Q, n, "Q");
    noise = known_Q_(Q->data(), n, "Q");
  } else {
    own.resize(n, n);
    model.noise(state_.x.data(), dt, own.data());
  }
  SigmaPoints X;
  if (!sigma_points(X)) {
    return done(FilterStatus::kNotPositive);
  }
  for (int k = 0; k <= 2 * n; ++k) {
    model.step(X.data() + k * n, dt, X.data() + k * n);
  }
  if (!all_finite(X.data(), static_cast<std::size_t>(X.size()))) {
    return done(FilterStatus::kNotFinite);
  }
  return predict_moved(X, noise);
}

FilterStatus UnscentedKalmanFilter::update(const StateVector& z, const SigmaPoints& Z,
                                           const StateMatrix& R, const UpdateOptions& options) {
  check_measurement(z);
  const int m = static_cast<int>(z.size());
  check_points(Z, m, size(), "h(x)");
  check_square(R, m, "R");
  const double* noise = known_R_(R.data(), m, "R");
  const double bound = gate_bound_(options.gate, m);
  return factor() ? update_seen(z, Z, noise, bound, options.angles)
                  : done(FilterStatus::kNotPositive);
}

FilterStatus UnscentedKalmanFilter::update_seen(const StateVector& z, const SigmaPoints& Z,
                                                const double* noise, double bound,
                                                const AngleSet& angles) noexcept {
  const auto m = static_cast<int>(z.size());
  UnscentedTransform seen;
  transform(Z, angles, seen);
  StateVector residual(m);
  angles.difference(z.data(), seen.mean.data(), residual.data(), m);
  return done(options_.square_root ? update_root(seen, residual.data(), noise, bound)
                                   : update_sums(seen, residual.data(), noise, bound));
}

FilterStatus UnscentedKalmanFilter::update(const StateVector& z, const MeasurementModel& model,
                                           const StateMatrix& R, double gate) {
  const int n = size();
  check_model(model, z, n);
  check_square(R, model.rows(), "R");
  const double* noise = known_R_(R.data(), model.rows(), "R");
  const double bound = gate_bound_(gate, model.rows());
  SigmaPoints X;
  if (!sigma_points(X)) {
    return done(FilterStatus::kNotPositive);
  }
  SigmaPoints Z(model.rows(), 2 * n + 1);
  for (int k = 0; k <= 2 * n; ++k) {
    model.evaluate(X.data() + k * n, Z.data() + k * model.rows());
  }
  if (!all_finite(Z.data(), static_cast<std::size_t>(Z.size()))) {
    return done(FilterStatus::kNotFinite);
  }
  return update_seen(z, Z, noise, bound, model.angles());
}

}  // namespace thing_kin
