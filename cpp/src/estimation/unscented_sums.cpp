// The unscented filter's steps as sums of squares: what keeps P rather than a factor of it.

#include "innovation.hpp"
#include "thing_kin/estimation/unscented_kalman.hpp"

namespace thing_kin {

namespace {

using kernels::put;
using kernels::Strip;
using kernels::strip;

// A (m, m) <- A + V V^T, V of `count` columns.
template <int M>
void add_squares(const double* V, int count, double* A, int rows) noexcept {
  const int m = kernels::size_of<M>(rows);
  for (int j = 0; j < m; ++j) {
    Strip<M> column = strip<M>(A + j * m, m);
    for (int k = 0; k < count; ++k) {
      column += strip<M>(V + k * m, m) * V[k * m + j];
    }
    put<M>(column, A + j * m);
  }
}

// A (m, m) <- A + the covariance that the slope does not explain.
template <int M>
void add_bend(const UnscentedTransform& made, double weight, double* A) noexcept {
  const int m = kernels::size_of<M>(static_cast<int>(made.shift.size()));
  add_squares<M>(made.bend.data(), static_cast<int>(made.bend.cols()), A, m);
  const Strip<M> shift = strip<M>(made.shift.data(), m);
  for (int j = 0; j < m; ++j) {
    put<M>(strip<M>(A + j * m, m) + shift * (weight * shift[j]), A + j * m);
  }
}

// out (n, r) <- A B^T, A (n, k) and B (r, k) in columns
template <int N>
void times_turned(const double* A, const double* B, double* out, int rows, int r, int k) noexcept {
  kernels::times_transposed<N, kernels::Layout::kColumns>(A, B, out, rows, r, k);
}

template <int N>
FilterStatus predict_by_sums(Gaussian& state, const UnscentedTransform& moved, double weight,
                             const double* Q) noexcept {
  const int n = kernels::size_of<N>(state.size());
  EntriesOf<N> P;
  std::copy_n(Q, n * n, P.data());
  add_squares<N>(moved.slope.data(), n, P.data(), n);
  add_bend<N>(moved, weight, P.data());
  std::array<double, kRowsOf<N>> x;
  std::copy_n(moved.mean.data(), n, x.data());
  return commit<N>(state, x.data(), P.data());
}

// S = A A^T + R in the coordinates of P's factor L, where P is the identity and A the slope.
template <int N, int M>
void see_sums(const UnscentedTransform& seen_as, const StateMatrix& L, const double* R,
              double weight, Innovation<N, M>& seen) noexcept {
  const int n = kernels::size_of<N>(static_cast<int>(L.rows()));
  const int m = kernels::size_of<M>(static_cast<int>(seen_as.shift.size()));
  std::copy_n(R, m * m, seen.R.data());
  add_bend<M>(seen_as, weight, seen.R.data());
  std::copy_n(seen.R.data(), m * m, seen.S.data());
  add_squares<M>(seen_as.slope.data(), n, seen.S.data(), m);
  times_turned<N>(L.data(), seen_as.slope.data(), seen.cross.data(), n, m, n);
}

// Joseph's form in the same coordinates: T T^T + K R K^T, T = L (I - L^-1 K A).
template <int N, int M>
void joseph_by_sums(const UnscentedTransform& seen_as, const StateMatrix& L,
                    const Innovation<N, M>& seen, double* P) noexcept {
  const int n = kernels::size_of<N>(static_cast<int>(L.rows()));
  const int m = kernels::size_of<M>(static_cast<int>(seen_as.shift.size()));
  Innovation<N, M> local;  // L^-1 K
  kernels::transpose(seen_as.slope.data(), local.cross.data(), m, n);
  std::copy_n(seen.root.data(), m * m, local.root.data());
  solve_gain(local, n, m);
  // (I - L^-1 K A)^T, in columns. GCC 12 does not see that all that is read is written.
  EntriesOf<N> rest{};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      double sum = i == j ? 1.0 : 0.0;
      for (int k = 0; k < m; ++k) {
        sum -= local.K[static_cast<std::size_t>(k * n + i)] * seen_as.slope.data()[j * m + k];
      }
      rest[static_cast<std::size_t>(i * n + j)] = sum;
    }
  }
  EntriesOf<N> T;
  times_turned<N>(L.data(), rest.data(), T.data(), n, n, n);
  std::fill_n(P, n * n, 0.0);
  add_squares<N>(T.data(), n, P, n);
  add_gained_noise(seen, n, m, P);
}

/// What an update sees, and with what.
struct SeenSums {
  const UnscentedTransform& made;
  const StateMatrix& L;
  const double* residual;
  const double* R;
  double weight;
  double bound;
};

template <int N, int M>
FilterStatus update_by_sums(Gaussian& state, const SeenSums& sums, FilterUpdate& update) noexcept {
  const int n = kernels::size_of<N>(state.size());
  const int m = kernels::size_of<M>(static_cast<int>(sums.made.shift.size()));
  Innovation<N, M> seen;
  see_sums(sums.made, sums.L, sums.R, sums.weight, seen);
  if (!factor_innovation(seen, m)) {
    return FilterStatus::kSingular;
  }
  solve_gain(seen, n, m);
  const FilterStatus noted = note_innovation(seen, sums.residual, sums.bound, n, m, update);
  if (noted != FilterStatus::kOk) {
    return noted;
  }
  std::array<double, kRowsOf<N>> x;
  std::copy_n(state.x.data(), n, x.data());
  gained(seen, sums.residual, n, m, x.data());
  EntriesOf<N> P;
  if (!expanded_joseph(state, seen, m, P.data())) {
    joseph_by_sums(sums.made, sums.L, seen, P.data());
  }
  const FilterStatus status = commit<N>(state, x.data(), P.data());
  update.accepted = status == FilterStatus::kOk;
  return status;
}

template <int M>
void transform_sized(const double* Y, int n, const AngleSet& angles, double scale,
                     UnscentedTransform& out) noexcept {
  const int m = kernels::size_of<M>(static_cast<int>(out.shift.size()));
  const double half = 0.5 / scale;
  const Strip<M> center = strip<M>(Y, m);
  Strip<M> sum = Strip<M>::Zero(m);
  for (int k = 0; k < n; ++k) {
    Strip<M> plus = strip<M>(Y + (k + 1) * m, m) - center;
    Strip<M> minus = strip<M>(Y + (n + k + 1) * m, m) - center;
    if (!angles.empty()) {
      angles.wrap(plus.data());
      angles.wrap(minus.data());
    }
    const Strip<M> bend = (plus + minus) * half;
    put<M>((plus - minus) * half, out.slope.data() + k * m);
    put<M>(bend, out.bend.data() + k * m);
    sum += bend;
  }
  put<M>(sum / scale, out.shift.data());
  put<M>(center + sum / scale, out.mean.data());
  angles.wrap(out.mean.data());
}

}  // namespace

void UnscentedKalmanFilter::transform(const SigmaPoints& Y, const AngleSet& angles,
                                      UnscentedTransform& out) const noexcept {
  const int n = size();
  const auto m = static_cast<int>(Y.rows());
  out.slope.resize(m, n);
  out.bend.resize(m, n);
  out.shift.resize(m);
  out.mean.resize(m);
  kernels::with_size(m, [&]<int M>() { transform_sized<M>(Y.data(), n, angles, scale_, out); });
}

FilterStatus UnscentedKalmanFilter::predict_sums(const UnscentedTransform& moved,
                                                 const double* Q) noexcept {
  return kernels::with_size(
      size(), [&]<int N>() { return predict_by_sums<N>(state_, moved, downdate_weight(), Q); });
}

FilterStatus UnscentedKalmanFilter::update_sums(const UnscentedTransform& seen,
                                                const double* residual, const double* R,
                                                double bound) noexcept {
  const SeenSums sums{seen, L_, residual, R, downdate_weight(), bound};
  const FilterStatus status = kernels::with_size(size(), [&]<int N>() {
    return kernels::with_rows(static_cast<int>(seen.shift.size()), [&]<int M>() {
      return update_by_sums < N, N == 0 ? 0 : M > (state_, sums, last_);
    });
  });
  factored_ = factored_ && status != FilterStatus::kOk;
  return status;
}

void UnscentedKalmanFilter::linearized_noise(const UnscentedTransform& moved,
                                             StateMatrix& noise) const noexcept {
  add_bend<0>(moved, downdate_weight(), noise.data());
}

}  // namespace thing_kin
