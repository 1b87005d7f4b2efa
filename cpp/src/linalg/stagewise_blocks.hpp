#pragma once

// Small dense blocks of StagewiseQp, in column order: M is their size if it is known when compiled,
// else 0 and m is.

#include <cmath>
#include <type_traits>
#include <vector>

namespace thing_kin {

/// Calls function(std::integral_constant<int, M>) for m of a common size, and with 0 for others.
template <typename Function>
auto with_size(int m, const Function& function) {
  switch (m) {
    case 1:
      return function(std::integral_constant<int, 1>{});
    case 3:
      return function(std::integral_constant<int, 3>{});
    case 4:
      return function(std::integral_constant<int, 4>{});
    default:
      return function(std::integral_constant<int, 0>{});
  }
}

template <int M>
double dot(int m, const double* a, const double* b) {
  const int n = M > 0 ? M : m;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

/// y += f x.
template <int M>
void add_scaled(int m, double f, const double* x, double* y) {
  const int n = M > 0 ? M : m;
  for (int i = 0; i < n; ++i) {
    y[i] += f * x[i];
  }
}

inline void add_all(double f, const std::vector<double>& x, std::vector<double>& y) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    y[i] += f * x[i];
  }
}

/// y += A x.
template <int M>
void add_product(int m, const double* A, const double* x, double* y) {
  const int n = M > 0 ? M : m;
  for (int j = 0; j < n; ++j) {
    add_scaled<M>(m, x[j], A + j * n, y);
  }
}

template <int M>
void subtract_product(int m, const double* A, const double* x, double* y) {
  const int n = M > 0 ? M : m;
  for (int j = 0; j < n; ++j) {
    add_scaled<M>(m, -x[j], A + j * n, y);
  }
}

/// y += A^T x.
template <int M>
void add_transposed_product(int m, const double* A, const double* x, double* y) {
  const int n = M > 0 ? M : m;
  for (int j = 0; j < n; ++j) {
    y[j] += dot<M>(m, A + j * n, x);
  }
}

template <int M>
void subtract_transposed_product(int m, const double* A, const double* x, double* y) {
  const int n = M > 0 ? M : m;
  for (int j = 0; j < n; ++j) {
    y[j] -= dot<M>(m, A + j * n, x);
  }
}

/// A += f a b^T.
template <int M>
void add_outer(int m, double f, const double* a, const double* b, double* A) {
  const int n = M > 0 ? M : m;
  for (int j = 0; j < n; ++j) {
    add_scaled<M>(m, f * b[j], a, A + j * n);
  }
}

/// A -= W^T W.
template <int M>
void subtract_gram(int m, const double* W, double* A) {
  const int n = M > 0 ? M : m;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      A[j * n + i] -= dot<M>(m, W + i * n, W + j * n);
    }
  }
}

/// A = L L^T in the lower triangle; false unless positive definite beyond rounding.
template <int M>
bool cholesky(int m, double* A) {
  constexpr double kLeast = 1e-14;
  const int n = M > 0 ? M : m;
  for (int j = 0; j < n; ++j) {
    double diagonal = A[j * n + j];
    const double before = diagonal;
    for (int k = 0; k < j; ++k) {
      diagonal -= A[k * n + j] * A[k * n + j];
    }
    if (!(diagonal > kLeast * std::abs(before)) || !(diagonal > 0.0)) {
      return false;
    }
    const double root = std::sqrt(diagonal);
    A[j * n + j] = root;
    for (int i = j + 1; i < n; ++i) {
      double sum = A[j * n + i];
      for (int k = 0; k < j; ++k) {
        sum -= A[k * n + i] * A[k * n + j];
      }
      A[j * n + i] = sum / root;
    }
  }
  return true;
}

/// x <- L^-1 x.
template <int M>
void solve_lower(int m, const double* L, double* x) {
  const int n = M > 0 ? M : m;
  for (int j = 0; j < n; ++j) {
    x[j] /= L[j * n + j];
    for (int i = j + 1; i < n; ++i) {
      x[i] -= L[j * n + i] * x[j];
    }
  }
}

/// x <- L^-T x.
template <int M>
void solve_lower_transposed(int m, const double* L, double* x) {
  const int n = M > 0 ? M : m;
  for (int j = n - 1; j >= 0; --j) {
    for (int i = j + 1; i < n; ++i) {
      x[j] -= L[j * n + i] * x[i];
    }
    x[j] /= L[j * n + j];
  }
}

}  // namespace thing_kin
