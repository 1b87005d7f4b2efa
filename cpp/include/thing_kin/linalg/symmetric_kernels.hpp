#pragma once

// The inner loops of covariances on plain arrays, for a size known to the compiler or, with N = 0,
// at run time. "Columns" are stored one after the other; a symmetric matrix reads the same either
// way. Factors are skipped where they are zero: the Jacobians of motion models mostly are.

#include <algorithm>
#include <array>
#include <cmath>

#include "thing_kin/core/tolerance.hpp"
#include "thing_kin/core/types.hpp"

namespace thing_kin::kernels {

/// The most rows of any matrix here.
inline constexpr int kMostRows = 32;
using Scratch = std::array<double, static_cast<std::size_t>(kMostRows* kMostRows)>;

template <int N>
constexpr int size_of(int n) noexcept {
  return N > 0 ? N : n;
}

/// The reciprocal of what is smaller overflows.
inline constexpr double kLeastPivot = 1e-300;

/// Pivots this many times their rounding error are clear of it.
inline constexpr double kClear = 8.0;

/// How a matrix of factors is stored.
enum class Layout : bool { kRows, kColumns };

/// A column that stays in registers where its length is known to the compiler.
template <int N>
using Strip = Eigen::Array<double, N == 0 ? Eigen::Dynamic : N, 1, Eigen::ColMajor,
                           N == 0 ? kMostRows : N, 1>;

template <int N>
Eigen::Map<const Strip<N>> strip(const double* column, int n) noexcept {
  return {column, n};
}

template <int N>
void put(const Strip<N>& from, double* column) noexcept {
  Eigen::Map<Strip<N>>(column, from.size()) = from;
}

/// F's entry (i, j) of k columns and r rows.
template <Layout L>
double factor_at(const double* F, int i, int j, int r, int k) noexcept {
  return L == Layout::kRows ? F[i * k + j] : F[j * r + i];
}

/// out (n, r) <- A F^T: A (n, k) and out in columns, F (r, k). out must not be A.
template <int N, Layout L = Layout::kRows>
void times_transposed(const double* A, const double* F, double* out, int rows, int r,
                      int k) noexcept {
  const int n = size_of<N>(rows);
  for (int i = 0; i < r; ++i) {
    Strip<N> sum = Strip<N>::Zero(n);
    for (int j = 0; j < k; ++j) {
      const double factor = factor_at<L>(F, i, j, r, k);
      if (factor != 0.0) {
        sum += strip<N>(A + j * n, n) * factor;
      }
    }
    put<N>(sum, out + i * n);
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

/// out (n, n) <- A^T. Two by two where n is even: what is stored one by one is slow to be read two
/// by two.
template <int N>
void transpose_square(const double* A, double* out, int size) noexcept {
  if constexpr (N == 0 || N % 2 != 0) {
    transpose(A, out, size, size);
  } else {
    for (int j = 0; j < N; j += 2) {
      for (int i = 0; i < N; i += 2) {
        const Strip<2> a = strip<2>(A + j * N + i, 2);
        const Strip<2> b = strip<2>(A + (j + 1) * N + i, 2);
        put<2>(Strip<2>(a[0], b[0]), out + i * N + j);
        put<2>(Strip<2>(a[1], b[1]), out + (i + 1) * N + j);
      }
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

/// A's upper triangle <- its lower one, by which a symmetric matrix is computed.
template <int N>
void mirror(double* A, int size) noexcept {
  const int n = size_of<N>(size);
  for (int j = 0; j < n; ++j) {
    for (int i = j + 1; i < n; ++i) {
      A[i * n + j] = A[j * n + i];
    }
  }
}

/// out (n, n) <- its lower triangle + F P F^T's, F (n, n), P symmetric; above it is anything.
template <int N, Layout L = Layout::kRows>
void add_congruence(const double* F, const double* P, double* out, int size) noexcept {
  const int n = size_of<N>(size);
  std::array<double, static_cast<std::size_t>(N > 0 ? N * N : kMostRows * kMostRows)> product;
  std::array<double, static_cast<std::size_t>(N > 0 ? N * N : kMostRows * kMostRows)> turned;
  times_transposed<N, L>(P, F, product.data(), n, n, n);
  transpose_square<N>(product.data(), turned.data(), n);
  const auto column = [&]<int Rows>(int i, int rows) {
    double* const to = out + i * n + n - rows;
    Strip<Rows> sum = strip<Rows>(to, rows);
    for (int j = 0; j < n; ++j) {
      const double factor = factor_at<L>(F, i, j, n, n);
      if (factor != 0.0) {
        sum += strip<Rows>(turned.data() + j * n + n - rows, rows) * factor;
      }
    }
    put<Rows>(sum, to);
  };
  for (int i = 0; i < n / 2; ++i) {
    column.template operator()<N>(i, n);
  }
  for (int i = n / 2; i < n; ++i) {  // what is above them is not needed
    column.template operator()<N - N / 2>(i, n - n / 2);
  }
}

/// out (n, n) <- F P F^T, F (n, n) in rows, P symmetric; exactly symmetric. out must not be P.
template <int N>
void congruence(const double* F, const double* P, double* out, int size) noexcept {
  const int n = size_of<N>(size);
  std::fill_n(out, n * n, 0.0);
  add_congruence<N>(F, P, out, n);
  mirror<N>(out, n);
}

/// The pivots of the last Rest rows of `from`, of which A's diagonal is what they must be clear of;
/// W (N, N) is for what is left of them, and may be `from`. Lower triangles.
template <int N, int Rest>
bool clear_pivots(const double* A, const double* from, double* W) noexcept {
  constexpr double kFloor = kClear * N * kEpsilon;
  constexpr int kFirst = N - Rest;
  const double* const u = from + kFirst * N + kFirst;
  if constexpr (Rest == 1) {
    return u[0] > kFloor * A[kFirst * N + kFirst];
  } else {
    const double* const v = u + N;
    const double a = u[0];
    const double b = u[1];
    const double c = v[1];
    const double det = a * c - b * b;
    if (!(a > kFloor * A[kFirst * N + kFirst] &&
          det > kFloor * A[(kFirst + 1) * N + kFirst + 1] * a)) {
      return false;
    }
    if constexpr (Rest > 2) {
      constexpr int kLeft = Rest - 2;
      const double inverse = 1.0 / det;
      const Strip<kLeft> U = strip<kLeft>(u + 2, kLeft);
      const Strip<kLeft> V = strip<kLeft>(v + 2, kLeft);
      const Strip<kLeft> p = (c * U - b * V) * inverse;
      const Strip<kLeft> q = (a * V - b * U) * inverse;
      for (int j = 0; j < kLeft; ++j) {
        const int at = (kFirst + 2 + j) * N + kFirst + 2;
        put<kLeft>(strip<kLeft>(from + at, kLeft) - U * p[j] - V * q[j], W + at);
      }
      return clear_pivots<N, kLeft>(A, W, W);
    }
    return true;
  }
}

/// Nearly always all of is_positive(): the pivots of L D L^T two at a time, with one division for
/// both. False where that does not tell, and where no size is known. Reads the lower triangle.
template <int N>
bool clearly_positive(const double* A) noexcept {
  if constexpr (N > 0) {
    std::array<double, static_cast<std::size_t>(N * N)> W;
    return clear_pivots<N, N>(A, A, W.data());
  }
  return false;
}

/// See is_positive(): the pivots of L D L^T against the diagonal, one after the other; those that
/// are known, with rows of zeros, are passed over.
template <int N>
bool passes_pivots(const double* A, int size) noexcept {
  const int n = size_of<N>(size);
  std::array<double, static_cast<std::size_t>(N > 0 ? N * N : kMostRows * kMostRows)> W;
  std::copy_n(A, n * n, W.data());
  const double floor = kClear * n * kEpsilon;
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

/// See is_positive().
template <int N>
bool is_positive(const double* A, int size) noexcept {
  return clearly_positive<N>(A) || passes_pivots<N>(A, size);
}

/// L (n, n) in columns <- the lower Cholesky factor of A, zero above the diagonal; see cholesky().
/// L may be A. Pivots must be above `margin` times the rounding error of their variance.
template <int N>
bool cholesky(const double* A, double* L, int size, double margin = 1.0) noexcept {
  const int n = size_of<N>(size);
  constexpr auto kRows = static_cast<std::size_t>(N > 0 ? N : kMostRows);
  const double floor = margin * n * kEpsilon;
  // Columns are divided by the roots of their pivots last, lest the next pivot wait for them.
  std::array<double, kRows * kRows> U;
  std::array<double, kRows> inverse;
  for (int k = 0; k < n; ++k) {
    double* const column = U.data() + k * n;
    Strip<N> rest = strip<N>(A + k * n, n);
    const double variance = rest[k];
    for (int j = 0; j < k; ++j) {
      const double* const before = U.data() + j * n;
      rest -= strip<N>(before, n) * (before[k] * inverse[static_cast<std::size_t>(j)]);
    }
    put<N>(rest, column);
    const double pivot = column[k];
    if (pivot > floor * variance && pivot > kLeastPivot) {
      inverse[static_cast<std::size_t>(k)] = 1.0 / pivot;
    } else if (variance == 0.0 &&
               std::all_of(column + k, column + n, [](double a) { return a == 0.0; })) {
      inverse[static_cast<std::size_t>(k)] = 0.0;
    } else {
      return false;  // NaN comes here too
    }
  }
  for (int k = 0; k < n; ++k) {
    const double* const column = U.data() + k * n;
    const double scale = std::sqrt(inverse[static_cast<std::size_t>(k)]);
    for (int i = 0; i < n; ++i) {
      L[k * n + i] = i < k ? 0.0 : column[i] * scale;
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

/// Calls work.template operator()<M>() with M = m up to 3, else with 0.
template <typename Work>
auto with_rows(int m, const Work& work) {
  switch (m) {
    case 1:
      return work.template operator()<1>();
    case 2:
      return work.template operator()<2>();
    case 3:
      return work.template operator()<3>();
    default:
      return work.template operator()<0>();
  }
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
