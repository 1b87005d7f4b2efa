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

// A <- A + sum over the columns v of V: v v^T, both triangles
void add_squares(const StateMatrix& V, double* A) noexcept {
  const Eigen::Index m = V.rows();
  for (Eigen::Index k = 0; k < V.cols(); ++k) {
    const double* v = V.data() + k * m;
    for (Eigen::Index j = 0; j < m; ++j) {
      if (v[j] == 0.0) {
        continue;
      }
      for (Eigen::Index i = 0; i < m; ++i) {
        A[j * m + i] += v[i] * v[j];
      }
    }
  }
}

// A <- A + the covariance that the slope does not explain
void add_bend(const UnscentedTransform& made, double weight, double* A) noexcept {
  add_squares(made.bend, A);
  const Eigen::Index m = made.shift.size();
  for (Eigen::Index j = 0; j < m; ++j) {
    const double factor = weight * made.shift.data()[j];
    for (Eigen::Index i = 0; i < m; ++i) {
      A[j * m + i] += made.shift.data()[i] * factor;
    }
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
  double* points = X.data();
  const double* x = state_.x.data();
  std::copy_n(x, n, points);
  for (int k = 0; k < n; ++k) {
    const double* column = L_.data() + k * n;
    double* const plus = points + (k + 1) * n;
    double* const minus = points + (n + k + 1) * n;
    for (int i = 0; i < n; ++i) {
      const double way = scale_ * column[i];
      plus[i] = x[i] + way;
      minus[i] = x[i] - way;
    }
  }
  return true;
}

void UnscentedKalmanFilter::transform(const SigmaPoints& Y, const AngleSet& angles,
                                      UnscentedTransform& out) const {
  const int n = size();
  const int m = static_cast<int>(Y.rows());
  const double* center = Y.data();
  const double half = 0.5 / scale_;
  out.slope.resize(m, n);
  out.bend.resize(m, n);
  out.shift.resize(m);
  out.mean.resize(m);
  std::array<double, static_cast<std::size_t>(kMaxState)> sum{};
  std::array<double, static_cast<std::size_t>(kMaxState)> plus;
  std::array<double, static_cast<std::size_t>(kMaxState)> minus;
  for (int k = 0; k < n; ++k) {
    angles.difference(center + (k + 1) * m, center, plus.data(), m);
    angles.difference(center + (n + k + 1) * m, center, minus.data(), m);
    for (int i = 0; i < m; ++i) {
      const auto at = static_cast<std::size_t>(i);
      out.slope.data()[k * m + i] = (plus[at] - minus[at]) * half;
      const double bend = (plus[at] + minus[at]) * half;
      out.bend.data()[k * m + i] = bend;
      sum[at] += bend;
    }
  }
  for (int i = 0; i < m; ++i) {
    out.shift.data()[i] = sum[static_cast<std::size_t>(i)] / scale_;
  }
  angles.retract(center, out.shift.data(), out.mean.data(), m);
}

FilterStatus UnscentedKalmanFilter::predict_sums(const UnscentedTransform& moved,
                                                 const double* Q) noexcept {
  const int n = size();
  StateMatrix noise = Eigen::Map<const StateMatrix>(Q, n, n);
  add_bend(moved, downdate_weight(), noise.data());
  ModelMatrix slope = moved.slope;
  Gaussian whitened{moved.mean, StateMatrix::Identity(n, n), state_.angles};
  const FilterStatus status =
      predict_linear(whitened, moved.mean.data(), slope.data(), noise.data());
  if (status == FilterStatus::kOk) {
    state_.x = whitened.x;
    state_.P = whitened.P;
  }
  return status;
}

FilterStatus UnscentedKalmanFilter::update_sums(const UnscentedTransform& seen,
                                                const double* residual, const double* R,
                                                double bound) noexcept {
  const int n = size();
  const auto m = static_cast<int>(seen.mean.size());
  StateMatrix noise = Eigen::Map<const StateMatrix>(R, m, m);
  add_bend(seen, downdate_weight(), noise.data());
  const ModelMatrix slope = seen.slope;
  Gaussian whitened{StateVector::Zero(n), StateMatrix::Identity(n, n), {}};
  const LinearMeasurement measured{m, residual, slope.data(), noise.data()};
  FilterStatus status = update_linear(whitened, measured, bound, last_);
  // Back: K = L K', x = x + L x', P = L P' L^T.
  const ModelMatrix root = L_;
  if (last_.any && status != FilterStatus::kSingular) {
    const StateMatrix gain = last_.K;
    last_.K.noalias() = L_.lazyProduct(gain);
  }
  if (status != FilterStatus::kOk) {
    return status;
  }
  StateMatrix P(n, n);
  kernels::with_size(n, [&]<int N>() {
    kernels::congruence<N>(root.data(), whitened.P.data(), P.data(), n);
    kernels::symmetrize<N>(P.data(), n);
  });
  const StateVector step = L_.lazyProduct(whitened.x);
  StateVector x(n);
  state_.angles.retract(state_.x.data(), step.data(), x.data(), n);
  if (!x.allFinite()) {
    status = FilterStatus::kNotFinite;
  } else if (!kernels::keep_positive<0>(P.data(), n, kMostInflation)) {
    status = FilterStatus::kNotPositive;
  } else {
    state_.x = x;
    state_.P = P;
    factored_ = false;
  }
  last_.accepted = status == FilterStatus::kOk;
  return status;
}

// x' = F x + noise with F L = slope: what a smoother needs of a nonlinear prediction.
void UnscentedKalmanFilter::note_slope(const UnscentedTransform& moved, const StateMatrix& L,
                                       const double* Q) noexcept {
  if (transition_ == nullptr || status_ != FilterStatus::kOk) {
    return;
  }
  const int n = size();
  StateMatrix noise = Eigen::Map<const StateMatrix>(Q, n, n);
  add_bend(moved, downdate_weight(), noise.data());
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
  if (!factor()) {
    return done(FilterStatus::kNotPositive);
  }
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
  SigmaPoints X;
  if (!sigma_points(X)) {
    return done(FilterStatus::kNotPositive);
  }
  StateMatrix own;
  if (Q == nullptr) {
    own.resize(n, n);
    model.noise(state_.x.data(), dt, own.data());
  }
  for (int k = 0; k <= 2 * n; ++k) {
    model.step(X.data() + k * n, dt, X.data() + k * n);
  }
  if (!all_finite(X.data(), static_cast<std::size_t>(X.size()))) {
    return done(FilterStatus::kNotFinite);
  }
  return predict(X, Q != nullptr ? *Q : own);
}

FilterStatus UnscentedKalmanFilter::update(const StateVector& z, const SigmaPoints& Z,
                                           const StateMatrix& R, const UpdateOptions& options) {
  check_measurement(z);
  const int m = static_cast<int>(z.size());
  check_points(Z, m, size(), "h(x)");
  check_square(R, m, "R");
  const double* noise = known_R_(R.data(), m, "R");
  const double bound = gate_bound_(options.gate, m);
  if (!factor()) {
    return done(FilterStatus::kNotPositive);
  }
  UnscentedTransform seen;
  transform(Z, options.angles, seen);
  StateVector residual(m);
  options.angles.difference(z.data(), seen.mean.data(), residual.data(), m);
  return done(options_.square_root ? update_root(seen, residual.data(), noise, bound)
                                   : update_sums(seen, residual.data(), noise, bound));
}

FilterStatus UnscentedKalmanFilter::update(const StateVector& z, const MeasurementModel& model,
                                           const StateMatrix& R, double gate) {
  const int n = size();
  check_model(model, z, n);
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
  return update(z, Z, R, {gate, model.angles()});
}

}  // namespace thing_kin
