#include "thing_kin/estimation/smoother.hpp"

#include <algorithm>
#include <array>

#include "thing_kin/linalg/symmetric_kernels.hpp"

namespace thing_kin {

namespace {

using Square = std::array<double, static_cast<std::size_t>(kMaxState) * kMaxState>;

// C L L^T = D by columns; a pivot of zero, a variance that is known, gives zero.
void divide_by_factor(const double* L, double* D, int n) noexcept {
  const auto scale = [&](int j) {
    const double inverse = L[j * n + j] > 0.0 ? 1.0 / L[j * n + j] : 0.0;
    for (int i = 0; i < n; ++i) {
      D[j * n + i] *= inverse;
    }
  };
  const auto subtract = [&](int j, int k, double factor) {
    for (int i = 0; i < n; ++i) {
      D[j * n + i] -= D[k * n + i] * factor;
    }
  };
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < j; ++k) {
      subtract(j, k, L[k * n + j]);
    }
    scale(j);
  }
  for (int j = n - 1; j >= 0; --j) {
    for (int k = j + 1; k < n; ++k) {
      subtract(j, k, L[j * n + k]);
    }
    scale(j);
  }
}

// C = P F^T (F P F^T + Q)^-1 in rows; zero, which smooths nothing, if there is no inverse.
void smoother_gain(const double* P, const double* F, const double* Q, int n, Square& C) noexcept {
  Square predicted;
  kernels::congruence<0>(F, P, predicted.data(), n);
  for (std::size_t i = 0, all = static_cast<std::size_t>(n * n); i < all; ++i) {
    predicted[i] += Q[i];
  }
  kernels::symmetrize<0>(predicted.data(), n);
  Square D{};
  if (kernels::keep_positive<0>(predicted.data(), n, kMostInflation) &&
      kernels::cholesky<0>(predicted.data(), predicted.data(), n)) {
    kernels::times_transposed<0>(P, F, D.data(), n, n, n);
    divide_by_factor(predicted.data(), D.data(), n);
  }
  kernels::transpose(D.data(), C.data(), n, n);
}

// (I - C F) P (I - C F)^T + C (next + Q) C^T
void smoothed_covariance(const double* P, const double* F, const double* Q, const double* next,
                         const Square& C, int n, double* out) noexcept {
  Square A;
  Square noise;
  for (int i = 0; i < n; ++i) {
    double* const row = A.data() + i * n;
    std::fill_n(row, n, 0.0);
    row[i] = 1.0;
    for (int k = 0; k < n; ++k) {
      for (int j = 0; j < n; ++j) {
        row[j] -= C[static_cast<std::size_t>(i * n + k)] * F[k * n + j];
      }
    }
  }
  for (int i = 0; i < n * n; ++i) {
    noise[static_cast<std::size_t>(i)] = Q[i] + next[i];
  }
  Square second;
  kernels::congruence<0>(A.data(), P, out, n);
  kernels::congruence<0>(C.data(), noise.data(), second.data(), n);
  for (int i = 0; i < n * n; ++i) {
    out[i] += second[static_cast<std::size_t>(i)];
  }
  kernels::symmetrize<0>(out, n);
  kernels::keep_positive<0>(out, n, kMostInflation);
}

}  // namespace

TransitionRecord::TransitionRecord(int n, Eigen::Index count)
    : n_(n),
      F_(static_cast<std::size_t>(count * n * n)),
      Q_(static_cast<std::size_t>(count * n * n)),
      x_(static_cast<std::size_t>(count * n)) {}

void TransitionRecord::store(Eigen::Index row, const Transition& transition) {
  std::copy_n(transition.F.data(), n_ * n_, F_.data() + row * n_ * n_);
  std::copy_n(transition.Q.data(), n_ * n_, Q_.data() + row * n_ * n_);
  std::copy_n(transition.x.data(), n_, x_.data() + row * n_);
}

void smooth_record(const TransitionRecord& record, const AngleSet& angles, Eigen::Index count,
                   int n, const double* x, const double* P, double* x_smooth, double* P_smooth) {
  if (count < 1) {
    return;
  }
  const Eigen::Index square = static_cast<Eigen::Index>(n) * n;
  std::copy_n(x + (count - 1) * n, n, x_smooth + (count - 1) * n);
  std::copy_n(P + (count - 1) * square, square, P_smooth + (count - 1) * square);
  Square C;
  std::array<double, static_cast<std::size_t>(kMaxState)> way;
  std::array<double, static_cast<std::size_t>(kMaxState)> step;
  for (Eigen::Index i = count - 2; i >= 0; --i) {
    const double* F = record.F(i + 1);
    const double* Q = record.Q(i + 1);
    smoother_gain(P + i * square, F, Q, n, C);
    angles.difference(x_smooth + (i + 1) * n, record.x(i + 1), way.data(), n);
    for (int j = 0; j < n; ++j) {
      double sum = 0.0;
      for (int k = 0; k < n; ++k) {
        sum += C[static_cast<std::size_t>(j * n + k)] * way[static_cast<std::size_t>(k)];
      }
      step[static_cast<std::size_t>(j)] = sum;
    }
    angles.retract(x + i * n, step.data(), x_smooth + i * n, n);
    smoothed_covariance(P + i * square, F, Q, P_smooth + (i + 1) * square, C, n,
                        P_smooth + i * square);
  }
}

}  // namespace thing_kin
