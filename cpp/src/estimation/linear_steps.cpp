#include "thing_kin/estimation/linear_steps.hpp"

#include "innovation.hpp"

namespace thing_kin {

namespace {

template <int N>
FilterStatus predict_sized(Gaussian& state, const double* fx, const double* F,
                           const double* Q) noexcept {
  const int n = kernels::size_of<N>(state.size());
  EntriesOf<N> P;
  std::copy_n(Q, n * n, P.data());
  kernels::add_congruence<N>(F, state.P.data(), P.data(), n);
  std::array<double, kRowsOf<N>> x;
  std::copy_n(fx, n, x.data());
  return commit<N>(state, x.data(), P.data());
}

// S = H P H^T + R, by its lower triangle.
template <int N, int M>
void see(const Gaussian& state, const LinearMeasurement& measured,
         Innovation<N, M>& seen) noexcept {
  const int n = kernels::size_of<N>(state.size());
  const int m = kernels::size_of<M>(measured.rows);
  kernels::times_transposed<N>(state.P.data(), measured.H, seen.cross.data(), n, m, n);
  std::copy_n(measured.R, m * m, seen.R.data());
  for (int j = 0; j < m; ++j) {
    const double* const column = seen.cross.data() + j * n;
    for (int i = j; i < m; ++i) {
      double sum = measured.R[j * m + i];
      for (int k = 0; k < n; ++k) {
        sum += measured.H[i * n + k] * column[k];
      }
      seen.S[static_cast<std::size_t>(j * m + i)] = sum;
    }
  }
}

// The lower triangle of (I - K H) P (I - K H)^T + K R K^T.
template <int N, int M>
void joseph(const Gaussian& state, const LinearMeasurement& measured, const Innovation<N, M>& seen,
            double* P) noexcept {
  const int n = kernels::size_of<N>(state.size());
  const int m = kernels::size_of<M>(measured.rows);
  EntriesOf<N> A{};  // I - K H, in columns: those that H does not see are the identity's
  for (int j = 0; j < n; ++j) {
    double* const column = A.data() + j * n;
    column[j] = 1.0;
    for (int k = 0; k < m; ++k) {
      const double factor = measured.H[k * n + j];
      for (int i = 0; factor != 0.0 && i < n; ++i) {
        column[i] -= seen.K[static_cast<std::size_t>(k * n + i)] * factor;
      }
    }
  }
  std::fill_n(P, n * n, 0.0);
  add_gained_noise(seen, n, m, P);
  kernels::add_congruence<N, kernels::Layout::kColumns>(A.data(), state.P.data(), P, n);
}

template <int N, int M>
FilterStatus update_sized(Gaussian& state, const LinearMeasurement& measured, double bound,
                          FilterUpdate& update) noexcept {
  const int n = kernels::size_of<N>(state.size());
  const int m = kernels::size_of<M>(measured.rows);
  if (n < 1 || m < 1) {
    return FilterStatus::kSingular;
  }
  Innovation<N, M> seen;
  see(state, measured, seen);
  if (!factor_innovation(seen, m)) {
    return FilterStatus::kSingular;
  }
  solve_gain(seen, n, m);
  const FilterStatus seen_as = note_innovation(seen, measured.residual, bound, n, m, update);
  if (seen_as != FilterStatus::kOk) {
    return seen_as;
  }
  std::array<double, kRowsOf<N>> x;
  std::copy_n(state.x.data(), n, x.data());
  gained(seen, measured.residual, n, m, x.data());
  EntriesOf<N> P;
  if (!expanded_joseph(state, seen, m, P.data())) {
    joseph(state, measured, seen, P.data());
  }
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
  return kernels::with_size(state.size(), [&]<int N>() {
    return kernels::with_rows(measurement.rows, [&]<int M>() {
      return update_sized < N, N == 0 ? 0 : M > (state, measurement, bound, update);
    });
  });
}

}  // namespace thing_kin
