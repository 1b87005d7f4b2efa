#include "thing_kin/estimation/linear_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "thing_kin/core/finite.hpp"
#include "thing_kin/linalg/symmetric_kernels.hpp"

namespace thing_kin {

namespace {

constexpr std::size_t kStateEntries = static_cast<std::size_t>(kMaxState) * kMaxState;
using Entries = std::array<double, kStateEntries>;
using Column = std::array<double, static_cast<std::size_t>(kMaxState)>;

// Commits what a step has made, if it is one.
template <int N>
FilterStatus commit(Gaussian& state, double* x, double* P) noexcept {
  const int n = state.size();
  state.angles.wrap(x);
  if (!all_finite(x, static_cast<std::size_t>(n)) ||
      !all_finite(P, static_cast<std::size_t>(n * n))) {
    return FilterStatus::kNotFinite;
  }
  if (!kernels::keep_positive<N>(P, n, kMostInflation)) {
    return FilterStatus::kNotPositive;
  }
  std::copy_n(x, n, state.x.data());
  std::copy_n(P, n * n, state.P.data());
  return FilterStatus::kOk;
}

template <int N>
FilterStatus predict_sized(Gaussian& state, const double* fx, const double* F,
                           const double* Q) noexcept {
  const int n = kernels::size_of<N>(state.size());
  Entries P;
  kernels::congruence<N>(F, state.P.data(), P.data(), n);
  for (int i = 0; i < n * n; ++i) {
    P[static_cast<std::size_t>(i)] += Q[i];
  }
  kernels::symmetrize<N>(P.data(), n);
  Column x;
  std::copy_n(fx, n, x.data());
  return commit<N>(state, x.data(), P.data());
}

// S = H P H^T + R, kept positive: where P H^T has lost the rows of H to rounding, R grows.
struct Innovation {
  Entries PHt;   // (n, m) in columns
  Entries S, R;  // (m, m)
  Entries root;  // (m, m), S's lower factor, in columns
};

template <int N>
bool see(const Gaussian& state, const LinearMeasurement& measured, Innovation& seen) noexcept {
  const int n = kernels::size_of<N>(state.size());
  const int m = measured.rows;
  if (m < 1 || n < 1) {
    return false;
  }
  kernels::times_transposed<N>(state.P.data(), measured.H, seen.PHt.data(), n, m, n);
  Entries turned;
  kernels::transpose(seen.PHt.data(), turned.data(), n, m);
  kernels::times_transposed<0>(turned.data(), measured.H, seen.S.data(), m, m, n);
  std::copy_n(measured.R, m * m, seen.R.data());
  for (std::size_t i = 0, all = static_cast<std::size_t>(m * m); i < all; ++i) {
    seen.S[i] += seen.R[i];
  }
  kernels::symmetrize<0>(seen.S.data(), m);
  Entries S;
  std::copy_n(seen.S.data(), m * m, S.data());
  if (!kernels::keep_positive<0>(S.data(), m, kMostInflation)) {
    return false;
  }
  for (int i = 0; i < m; ++i) {
    const auto k = static_cast<std::size_t>(i * m + i);
    seen.R[k] += S[k] - seen.S[k];
    if (S[k] == 0.0) {
      return false;
    }
  }
  std::copy_n(S.data(), m * m, seen.S.data());
  return kernels::cholesky<0>(seen.S.data(), seen.root.data(), m);
}

// K = P H^T S^-1, by columns: K L L^T = P H^T.
void solve_gain(const Innovation& seen, double* K, int n, int m) noexcept {
  const double* L = seen.root.data();
  std::copy_n(seen.PHt.data(), n * m, K);
  for (int j = 0; j < m; ++j) {
    for (int k = 0; k < j; ++k) {
      for (int i = 0; i < n; ++i) {
        K[j * n + i] -= K[k * n + i] * L[k * m + j];
      }
    }
    const double inverse = 1.0 / L[j * m + j];
    for (int i = 0; i < n; ++i) {
      K[j * n + i] *= inverse;
    }
  }
  for (int j = m - 1; j >= 0; --j) {
    for (int k = j + 1; k < m; ++k) {
      for (int i = 0; i < n; ++i) {
        K[j * n + i] -= K[k * n + i] * L[j * m + k];
      }
    }
    const double inverse = 1.0 / L[j * m + j];
    for (int i = 0; i < n; ++i) {
      K[j * n + i] *= inverse;
    }
  }
}

// The NIS and ln det S from S's factor.
void judge(const Innovation& seen, const LinearMeasurement& measured, FilterUpdate& update) {
  const int m = measured.rows;
  const double* L = seen.root.data();
  Column y;
  double nis = 0.0;
  double product = 1.0;
  double log_det = 0.0;
  for (int i = 0; i < m; ++i) {
    double value = measured.residual[i];
    for (int k = 0; k < i; ++k) {
      value -= L[k * m + i] * y[static_cast<std::size_t>(k)];
    }
    value /= L[i * m + i];
    y[static_cast<std::size_t>(i)] = value;
    nis += value * value;
    product *= L[i * m + i];
    if ((i & 1) != 0 || i + 1 == m) {  // two at a time overflow only with their squares
      log_det += 2.0 * std::log(product);
      product = 1.0;
    }
  }
  update.nis = nis;
  update.log_det = log_det;
}

void note(const Innovation& seen, const LinearMeasurement& measured, const double* K, int n,
          FilterUpdate& update) noexcept {
  const int m = measured.rows;
  update.innovation.resize(m);
  update.S.resize(m, m);
  update.K.resize(n, m);
  std::copy_n(measured.residual, m, update.innovation.data());
  std::copy_n(seen.S.data(), m * m, update.S.data());
  std::copy_n(K, n * m, update.K.data());
  judge(seen, measured, update);
  update.any = true;
}

// (I - K H) P (I - K H)^T + K R K^T
template <int N>
void joseph(const Gaussian& state, const LinearMeasurement& measured, const Innovation& seen,
            const double* K, double* P) noexcept {
  const int n = kernels::size_of<N>(state.size());
  const int m = measured.rows;
  Entries A;  // I - K H, in rows
  for (int i = 0; i < n; ++i) {
    double* const row = A.data() + i * n;
    std::fill_n(row, n, 0.0);
    row[i] = 1.0;
    for (int k = 0; k < m; ++k) {
      const double gain = K[k * n + i];
      for (int j = 0; j < n; ++j) {
        row[j] -= gain * measured.H[k * n + j];
      }
    }
  }
  Entries KR;
  Entries turned{};  // GCC 12 does not see that all that is read is written
  Entries noise;
  kernels::times_transposed<N>(K, seen.R.data(), KR.data(), n, m, m);
  kernels::transpose(K, turned.data(), n, m);
  kernels::times_transposed<N>(KR.data(), turned.data(), noise.data(), n, n, m);
  kernels::congruence<N>(A.data(), state.P.data(), P, n);
  for (std::size_t i = 0, all = static_cast<std::size_t>(n * n); i < all; ++i) {
    P[i] += noise[i];
  }
  kernels::symmetrize<N>(P, n);
}

template <int N>
FilterStatus update_sized(Gaussian& state, const LinearMeasurement& measured, double bound,
                          FilterUpdate& update) noexcept {
  const int n = kernels::size_of<N>(state.size());
  const int m = measured.rows;
  Innovation seen;
  if (!see<N>(state, measured, seen)) {
    return FilterStatus::kSingular;
  }
  Entries K;
  solve_gain(seen, K.data(), n, m);
  note(seen, measured, K.data(), n, update);
  update.accepted = false;
  if (!std::isfinite(update.nis)) {
    update.any = false;
    return FilterStatus::kNotFinite;
  }
  if (update.nis > bound) {
    return FilterStatus::kRejected;
  }
  Column x;
  std::copy_n(state.x.data(), n, x.data());
  for (int k = 0; k < m; ++k) {
    for (int i = 0; i < n; ++i) {
      x[static_cast<std::size_t>(i)] +=
          K[static_cast<std::size_t>(k * n + i)] * measured.residual[k];
    }
  }
  Entries P;
  joseph<N>(state, measured, seen, K.data(), P.data());
  const FilterStatus status = commit<N>(state, x.data(), P.data());
  update.accepted = status == FilterStatus::kOk;
  return status;
}

}  // namespace

FilterStatus predict_linear(Gaussian& state, const double* fx, const double* F,
                            const double* Q) noexcept {
  return kernels::with_size(state.size(),
                            [&]<int N>() { return predict_sized<N>(state, fx, F, Q); });
}

FilterStatus update_linear(Gaussian& state, const LinearMeasurement& measurement, double bound,
                           FilterUpdate& update) noexcept {
  return kernels::with_size(
      state.size(), [&]<int N>() { return update_sized<N>(state, measurement, bound, update); });
}

}  // namespace thing_kin
