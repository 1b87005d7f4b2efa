// The square-root form: factors of covariances are stacked and made triangular again, so that no
// covariance is ever added up, and positivity is lost only where a down-date takes it.

#include <array>
#include <cmath>

#include "thing_kin/core/finite.hpp"
#include "thing_kin/estimation/unscented_kalman.hpp"
#include "thing_kin/linalg/symmetric_kernels.hpp"

namespace thing_kin {

namespace {

// Rows of [slope, bend, root of the noise], (m, n + n + m) at most.
using Stack = std::array<double, static_cast<std::size_t>(3 * kMaxState * kMaxState)>;

void put(const StateMatrix& A, double* rows, int at, int width) noexcept {
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      rows[i * width + at + j] = A(i, j);
    }
  }
}

StateMatrix lower_of(const double* rows, int n, int width) noexcept {
  StateMatrix L(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      L(i, j) = rows[i * width + j];
    }
  }
  return L;
}

// The factor of a covariance that was checked; one that is semidefinite only grows by rounding.
bool noise_root(const double* noise, int m, StateMatrix& root) noexcept {
  root = Eigen::Map<const StateMatrix>(noise, m, m);
  return kernels::keep_positive<0>(root.data(), m, kMostInflation) &&
         kernels::cholesky<0>(root.data(), root.data(), m);
}

// L of blocks stacked side by side, then the rank-one term added or taken away.
template <typename... Blocks>
bool stacked(StateMatrix& L, const StateVector& shift, double weight,
             const Blocks&... blocks) noexcept {
  const int m = static_cast<int>(shift.size());
  const int width = static_cast<int>((blocks.cols() + ...));
  Stack rows;
  int at = 0;
  ((put(blocks, rows.data(), at, width), at += static_cast<int>(blocks.cols())), ...);
  lower_factor(rows.data(), m, width);
  L = lower_of(rows.data(), m, width);
  return weight == 0.0 || cholesky_update(L, shift, weight);
}

StateMatrix square(const StateMatrix& L) noexcept {
  StateMatrix P = L.lazyProduct(L.transpose());
  symmetrize(P);
  return P;
}

// Solves K S = A^T for the gain in the coordinates of P's factor: A the slope (m, n).
StateMatrix gain_of(const StateMatrix& slope, const StateMatrix& root) noexcept {
  StateMatrix gain = slope;  // S^-1 slope, by its rows
  const Eigen::Index m = slope.rows();
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index k = 0; k < i; ++k) {
      gain.row(i) -= root(i, k) * gain.row(k);
    }
    gain.row(i) /= root(i, i);
  }
  for (Eigen::Index i = m - 1; i >= 0; --i) {
    for (Eigen::Index k = i + 1; k < m; ++k) {
      gain.row(i) -= root(k, i) * gain.row(k);
    }
    gain.row(i) /= root(i, i);
  }
  return gain.transpose();
}

void note_root(const double* residual, const StateMatrix& root, const StateMatrix& K,
               FilterUpdate& update) noexcept {
  const Eigen::Index m = root.rows();
  update.innovation = Eigen::Map<const StateVector>(residual, m);
  update.S = square(root);
  update.K = K;
  StateVector y = update.innovation;
  update.log_det = 0.0;
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index k = 0; k < i; ++k) {
      y[i] -= root(i, k) * y[k];
    }
    y[i] /= root(i, i);
    update.log_det += 2.0 * std::log(root(i, i));
  }
  update.nis = y.squaredNorm();
  update.accepted = false;
  update.any = std::isfinite(update.nis);
}

}  // namespace

FilterStatus UnscentedKalmanFilter::predict_root(const UnscentedTransform& moved,
                                                 const double* Q) noexcept {
  const int n = size();
  StateMatrix noise;
  StateMatrix L;
  if (!noise_root(Q, n, noise) ||
      !stacked(L, moved.shift, downdate_weight(), moved.slope, moved.bend, noise)) {
    return FilterStatus::kNotPositive;
  }
  StateMatrix P = square(L);
  if (!P.allFinite() || !moved.mean.allFinite()) {
    return FilterStatus::kNotFinite;
  }
  keep_positive(P);  // what is read is a covariance too
  state_.x = moved.mean;
  state_.P = P;
  L_ = L;
  return FilterStatus::kOk;
}

FilterStatus UnscentedKalmanFilter::update_root(const UnscentedTransform& seen,
                                                const double* residual, const double* R,
                                                double bound) noexcept {
  const int n = size();
  const auto m = static_cast<int>(seen.mean.size());
  StateMatrix noise;
  StateMatrix root;
  if (!noise_root(R, m, noise) ||
      !stacked(root, seen.shift, downdate_weight(), seen.slope, seen.bend, noise) ||
      !(root.diagonal().array() > 0.0).all()) {
    return FilterStatus::kSingular;
  }
  const StateMatrix gain = gain_of(seen.slope, root);
  note_root(residual, root, L_.lazyProduct(gain), last_);
  if (!last_.any) {
    return FilterStatus::kNotFinite;
  }
  if (last_.nis > bound) {
    return FilterStatus::kRejected;
  }
  // In L's coordinates: (I - K A) (I - K A)^T + K (bend, R) K^T + weight (K d) (K d)^T.
  StateMatrix rest = StateMatrix::Identity(n, n);
  rest.noalias() -= gain.lazyProduct(seen.slope);
  const StateMatrix bend = gain.lazyProduct(seen.bend);
  const StateMatrix noisy = gain.lazyProduct(noise);
  const StateVector shift = gain.lazyProduct(seen.shift);
  StateMatrix local;
  if (!stacked(local, shift, downdate_weight(), rest, bend, noisy)) {
    return FilterStatus::kNotPositive;
  }
  const StateMatrix L = L_.lazyProduct(local);
  const StateVector step = L_.lazyProduct(gain.lazyProduct(last_.innovation));
  StateVector x(n);
  state_.angles.retract(state_.x.data(), step.data(), x.data(), n);
  StateMatrix P = square(L);
  if (!x.allFinite() || !P.allFinite()) {
    return FilterStatus::kNotFinite;
  }
  keep_positive(P);
  state_.x = x;
  state_.P = P;
  L_ = L;
  last_.accepted = true;
  return FilterStatus::kOk;
}

}  // namespace thing_kin
