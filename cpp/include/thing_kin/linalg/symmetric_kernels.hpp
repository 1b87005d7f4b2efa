#pragma once

// The inner loops of covariances on plain arrays, for a size known to the compiler or, with N = 0,
// at run time. "Columns" are stored one after the other; a symmetric matrix reads the same either
// way. Factors are skipped where they are zero: the Jacobians of motion models mostly are.

#include <algorithm>
#include <array>
#include <cmath>

#include "thing_kin/core/tolerance.hpp"

namespace thing_kin::kernels {

/// The most rows of any matrix here.
inline constexpr int kMostRows = 32;
using Scratch = std::array<double, static_cast<std::size_t>(kMostRows* kMostRows)>;

template <int N>
constexpr int size_of(int n) noexcept {
  return N > 0 ? N : n;
}

/// out (n, r) <- A F^T: A (n, k) and out in columns, F (r, k) in rows. out must not be A.
template <int N>
void times_transposed(const double* A, const double* F, double* out, int rows, int r,
                      int k) noexcept {
  const int n = size_of<N>(rows);
  for (int i = 0; i < r; ++i) {
    std::array<double, static_cast<std::size_t>(N > 0 ? N : kMostRows)> sum{};
    for (int j = 0; j < k; ++j) {
      const double factor = F[i * k + j];
      if (factor == 0.0) {
        continue;
      }
      const double* column = A + j * n;
      for (int l = 0; l < n; ++l) {
        sum[static_cast<std::size_t>(l)] += column[l] * factor;
      }
    }
    std::copy_n(sum.data(), n, out + i * n);
  }
}

/// out (c, r) <- the transpose of A (r, c), both in columns.
inline void transpose(const double* A, double* out, int r, int c) noexcept {
  for (int j = 0; j < c; ++j) {
    for (int i = 0; i < r; ++i) {
      out[i * c + j] = A[j * r + i];
    }
  }
}

template <int N>
void symmetrize(double* A, int size) noexcept {
  const int n = size_of<N>(size);
  for (int j = 0; j < n; ++j) {
    for (int i = j + 1; i < n; ++i) {
      A[j * n + i] = A[i * n + j] = 0.5 * (A[j * n + i] + A[i * n + j]);
    }
  }
}

/// out (n, n) <- F P F^T, F (n, n) in rows, P symmetric; symmetric to rounding. out may be P.
template <int N>
void congruence(const double* F, const double* P, double* out, int size) noexcept {
  const int n = size_of<N>(size);
  if (n < 1) {
    return;
  }
  std::array<double, static_cast<std::size_t>(N > 0 ? N * N : kMostRows * kMostRows)> product;
  std::array<double, static_cast<std::size_t>(N > 0 ? N * N : kMostRows * kMostRows)> turned;
  times_transposed<N>(P, F, product.data(), n, n, n);
  transpose(product.data(), turned.data(), n, n);
  times_transposed<N>(turned.data(), F, out, n, n, n);
}

/// See is_positive(): the pivots of L D L^T against the diagonal.
template <int N>
bool is_positive(const double* A, int size) noexcept {
  const int n = size_of<N>(size);
  std::array<double, static_cast<std::size_t>(N > 0 ? N * N : kMostRows * kMostRows)> W;
  std::copy_n(A, n * n, W.data());
  const double floor = 8.0 * n * kEpsilon;
  for (int k = 0; k < n; ++k) {
    double* const column = W.data() + k * n;
    const double pivot = column[k];
    if (!(pivot > floor * A[k * n + k])) {
      const bool known = std::all_of(A + k * n, A + k * n + n, [](double a) { return a == 0.0; });
      if (!known) {
        return false;
      }
      continue;
    }
    const double inverse = 1.0 / pivot;
    for (int j = k + 1; j < n; ++j) {
      const double factor = column[j] * inverse;
      for (int i = k + 1; i < n; ++i) {
        W[static_cast<std::size_t>(j * n + i)] -= column[i] * factor;
      }
    }
  }
  return true;
}

/// L (n, n) in columns <- the lower Cholesky factor of A, zero above the diagonal; see cholesky().
/// L may be A.
template <int N>
bool cholesky(const double* A, double* L, int size) noexcept {
  const int n = size_of<N>(size);
  const double floor = n * kEpsilon;
  for (int k = 0; k < n; ++k) {
    std::array<double, static_cast<std::size_t>(N > 0 ? N : kMostRows)> column;
    std::copy_n(A + k * n, n, column.data());
    const double variance = column[static_cast<std::size_t>(k)];
    for (int j = 0; j < k; ++j) {
      const double factor = L[j * n + k];
      for (int i = 0; i < n; ++i) {
        column[static_cast<std::size_t>(i)] -= L[j * n + i] * factor;
      }
    }
    const double pivot = column[static_cast<std::size_t>(k)];
    double inverse = 0.0;
    if (pivot > floor * variance) {
      inverse = 1.0 / std::sqrt(pivot);
    } else if (variance != 0.0 || std::any_of(column.data() + k, column.data() + n,
                                              [](double a) { return a != 0.0; })) {
      return false;  // NaN comes here too
    }
    for (int i = 0; i < n; ++i) {
      L[k * n + i] = i < k ? 0.0 : column[static_cast<std::size_t>(i)] * inverse;
    }
  }
  return true;
}

/// See keep_positive().
template <int N>
bool keep_positive(double* A, int size, double most) noexcept {
  if (is_positive<N>(A, size)) {
    return true;
  }
  const int n = size_of<N>(size);
  Scratch grown;
  double fraction = 16.0 * n * kEpsilon;
  while (fraction <= most) {
    std::copy_n(A, n * n, grown.data());
    for (int k = 0; k < n; ++k) {
      grown[static_cast<std::size_t>(k * n + k)] *= 1.0 + fraction;
    }
    if (is_positive<N>(grown.data(), n)) {
      std::copy_n(grown.data(), n * n, A);
      return true;
    }
    fraction *= 4.0;
  }
  return false;
}

/// Calls work.template operator()<N>() with N = n where the size is a frequent one, else with 0.
template <typename Work>
auto with_size(int n, const Work& work) {
  switch (n) {
    case 2:
      return work.template operator()<2>();
    case 3:
      return work.template operator()<3>();
    case 4:
      return work.template operator()<4>();
    case 6:
      return work.template operator()<6>();
    case 8:
      return work.template operator()<8>();
    default:
      return work.template operator()<0>();
  }
}

}  // namespace thing_kin::kernels
