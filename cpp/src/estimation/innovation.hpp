#pragma once

// What the updates of all filters do with an innovation, for sizes known to the compiler or, where
// they are 0, at run time.

#include <algorithm>
#include <array>
#include <cmath>

#include "thing_kin/core/finite.hpp"
#include "thing_kin/estimation/linear_steps.hpp"
#include "thing_kin/linalg/symmetric_kernels.hpp"

namespace thing_kin {

template <int N>
inline constexpr std::size_t kRowsOf = N > 0 ? static_cast<std::size_t>(N) : kMaxState;

template <int N, int M = N>
using EntriesOf = std::array<double, kRowsOf<N> * kRowsOf<M>>;

/// An innovation of m entries, as a state of n sees it; matrices in columns.
template <int N, int M>
struct Innovation {
  EntriesOf<N, M> cross;  ///< (n, m), covariance of state and measurement, P H^T
  EntriesOf<M> R;         ///< (m, m), noise
  EntriesOf<M> S;         ///< (m, m), its covariance, by its lower triangle
  EntriesOf<M> root;      ///< (m, m), the lower factor of S
  EntriesOf<N, M> K;      ///< (n, m), the gain
};

/// The factor of S. Where S is not clear of rounding it is kept positive, and R grows with it;
/// false where that does not do.
template <int N, int M>
bool factor_innovation(Innovation<N, M>& seen, int rows) noexcept {
  const int m = kernels::size_of<M>(rows);
  kernels::mirror<M>(seen.S.data(), m);
  if (!kernels::cholesky<M>(seen.S.data(), seen.root.data(), m, kernels::kClear)) {
    EntriesOf<M> kept;
    std::copy_n(seen.S.data(), m * m, kept.data());
    if (!kernels::keep_positive<M>(kept.data(), m, kMostInflation) ||
        !kernels::cholesky<M>(kept.data(), seen.root.data(), m)) {
      return false;
    }
    for (int i = 0; i < m; ++i) {
      const auto k = static_cast<std::size_t>(i * m + i);
      seen.R[k] += kept[k] - seen.S[k];
    }
    std::copy_n(kept.data(), m * m, seen.S.data());
  }
  for (int i = 0; i < m; ++i) {
    if (!(seen.root[static_cast<std::size_t>(i * m + i)] > 0.0)) {
      return false;
    }
  }
  return true;
}

/// K = cross S^-1, by columns: K L L^T = cross.
template <int N, int M>
void solve_gain(Innovation<N, M>& seen, int states, int rows) noexcept {
  const int n = kernels::size_of<N>(states);
  const int m = kernels::size_of<M>(rows);
  const double* L = seen.root.data();
  double* const K = seen.K.data();
  std::copy_n(seen.cross.data(), n * m, K);
  for (int j = 0; j < m; ++j) {
    kernels::Strip<N> column = kernels::strip<N>(K + j * n, n);
    for (int k = 0; k < j; ++k) {
      column -= kernels::strip<N>(K + k * n, n) * L[k * m + j];
    }
    kernels::put<N>(column * (1.0 / L[j * m + j]), K + j * n);
  }
  for (int j = m - 1; j >= 0; --j) {
    kernels::Strip<N> column = kernels::strip<N>(K + j * n, n);
    for (int k = j + 1; k < m; ++k) {
      column -= kernels::strip<N>(K + k * n, n) * L[j * m + k];
    }
    kernels::put<N>(column * (1.0 / L[j * m + j]), K + j * n);
  }
}

/// The NIS and ln det S from S's factor.
template <int N, int M>
void judge_innovation(const Innovation<N, M>& seen, const double* residual, int rows,
                      FilterUpdate& update) noexcept {
  const int m = kernels::size_of<M>(rows);
  const double* L = seen.root.data();
  std::array<double, kRowsOf<M>> y;
  double nis = 0.0;
  double product = 1.0;
  double log_det = 0.0;
  for (int i = 0; i < m; ++i) {
    double value = residual[i];
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

/// Writes the innovation down, with its NIS: kOk, or why there is no update.
template <int N, int M>
FilterStatus note_innovation(const Innovation<N, M>& seen, const double* residual, double bound,
                             int states, int rows, FilterUpdate& update) noexcept {
  const int n = kernels::size_of<N>(states);
  const int m = kernels::size_of<M>(rows);
  update.innovation.resize(m);
  update.S.resize(m, m);
  update.K.resize(n, m);
  std::copy_n(residual, m, update.innovation.data());
  std::copy_n(seen.S.data(), m * m, update.S.data());
  std::copy_n(seen.K.data(), n * m, update.K.data());
  judge_innovation(seen, residual, m, update);
  update.accepted = false;
  update.any = std::isfinite(update.nis);
  if (!update.any) {
    return FilterStatus::kNotFinite;
  }
  return update.nis > bound ? FilterStatus::kRejected : FilterStatus::kOk;
}

/// P (n, n) <- its lower triangle + K R K^T's.
template <int N, int M>
void add_gained_noise(const Innovation<N, M>& seen, int states, int rows, double* P) noexcept {
  const int n = kernels::size_of<N>(states);
  const int m = kernels::size_of<M>(rows);
  EntriesOf<N, M> KR;
  kernels::times_transposed<N>(seen.K.data(), seen.R.data(), KR.data(), n, m, m);
  for (int j = 0; j < n; ++j) {
    kernels::Strip<N> column = kernels::strip<N>(P + j * n, n);
    for (int k = 0; k < m; ++k) {
      column +=
          kernels::strip<N>(KR.data() + k * n, n) * seen.K[static_cast<std::size_t>(k * n + j)];
    }
    kernels::put<N>(column, P + j * n);
  }
}

/// P (n, n), by its lower triangle, <- Joseph's form with its products multiplied out,
///   P - K cross^T - (cross - K S) K^T,
/// which like it is right to second order in the errors of K. False, and P is anything, where a
/// variance falls so far that the differences would cancel.
template <int N, int M>
bool expanded_joseph(const Gaussian& state, const Innovation<N, M>& seen, int rows,
                     double* P) noexcept {
  constexpr double kMostFall = 1.0 / 16.0;
  const int n = kernels::size_of<N>(state.size());
  const int m = kernels::size_of<M>(rows);
  EntriesOf<N, M> rest;  // cross - K S
  for (int j = 0; j < m; ++j) {
    kernels::Strip<N> column = kernels::strip<N>(seen.cross.data() + j * n, n);
    for (int k = 0; k < m; ++k) {
      column -=
          kernels::strip<N>(seen.K.data() + k * n, n) * seen.S[static_cast<std::size_t>(j * m + k)];
    }
    kernels::put<N>(column, rest.data() + j * n);
  }
  bool clear = true;
  const auto column = [&]<int Rows>(int j, int rows_left) {
    const int first = n - rows_left;
    kernels::Strip<Rows> sum = kernels::strip<Rows>(state.P.data() + j * n + first, rows_left);
    for (int k = 0; k < m; ++k) {
      const auto at = static_cast<std::size_t>(k * n + j);
      sum -= kernels::strip<Rows>(seen.K.data() + k * n + first, rows_left) * seen.cross[at] +
             kernels::strip<Rows>(rest.data() + k * n + first, rows_left) * seen.K[at];
    }
    clear = clear && sum[j - first] >= kMostFall * state.P.data()[j * n + j];
    kernels::put<Rows>(sum, P + j * n + first);
  };
  for (int j = 0; j < n / 2; ++j) {
    column.template operator()<N>(j, n);
  }
  for (int j = n / 2; j < n; ++j) {  // what is above them is not needed
    std::fill_n(P + j * n, n / 2, 0.0);
    column.template operator()<N - N / 2>(j, n - n / 2);
  }
  return clear;
}

/// x + K residual
template <int N, int M>
void gained(const Innovation<N, M>& seen, const double* residual, int states, int rows,
            double* x) noexcept {
  const int n = kernels::size_of<N>(states);
  const int m = kernels::size_of<M>(rows);
  kernels::Strip<N> sum = kernels::strip<N>(x, n);
  for (int k = 0; k < m; ++k) {
    sum += kernels::strip<N>(seen.K.data() + k * n, n) * residual[k];
  }
  kernels::put<N>(sum, x);
}

/// Where P's positivity is not clear: kOk if it is kept.
template <int N>
FilterStatus keep_or_refuse(double* P, int n) noexcept {
  kernels::mirror<N>(P, n);
  if (!all_finite(P, static_cast<std::size_t>(n * n))) {
    return FilterStatus::kNotFinite;
  }
  return kernels::keep_positive<N>(P, n, kMostInflation) ? FilterStatus::kOk
                                                         : FilterStatus::kNotPositive;
}

/// Commits what a step has made, if it is one: P by its lower triangle.
template <int N>
FilterStatus commit(Gaussian& state, double* x, double* P) noexcept {
  const int n = kernels::size_of<N>(state.size());
  state.angles.wrap(x);
  if (!all_finite(x, static_cast<std::size_t>(n))) {
    return FilterStatus::kNotFinite;
  }
  if (!kernels::clearly_positive<N>(P)) {  // nor is what is not finite
    const FilterStatus kept = keep_or_refuse<N>(P, n);
    if (kept != FilterStatus::kOk) {
      return kept;
    }
  }
  kernels::put<N>(kernels::strip<N>(x, n), state.x.data());
  for (int j = 0; j < n; ++j) {
    kernels::put<N>(kernels::strip<N>(P + j * n, n), state.P.data() + j * n);
  }
  kernels::mirror<N>(state.P.data(), n);
  return FilterStatus::kOk;
}

}  // namespace thing_kin
