#include "thing_kin/linalg/spd.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/symmetric_kernels.hpp"

namespace thing_kin {

namespace {

void copy_columns(const MatrixView& A, double* out) noexcept {
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    std::copy_n(A.data() + j * A.outerStride(), A.rows(), out + j * A.rows());
  }
}

void write_columns(const double* from, MatrixSpan A) noexcept {
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    std::copy_n(from + j * A.rows(), A.rows(), A.data() + j * A.outerStride());
  }
}

std::string sizes(const MatrixView& A) {
  std::string text("shape (");
  return text.append(std::to_string(A.rows())).append(", ").append(std::to_string(A.cols())) + ")";
}

void check_symmetric(const MatrixView& A, const std::string& name) {
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    if (!(A(i, i) >= 0.0)) {
      throw InvalidArgument(name, "a variance of " + text(A(i, i)), "variances from 0");
    }
    for (Eigen::Index j = 0; j < i; ++j) {
      const double scale = std::sqrt(A(i, i)) * std::sqrt(A(j, j));
      if (!(std::abs(A(i, j) - A(j, i)) <= kCovarianceTolerance * scale)) {
        throw InvalidArgument(
            name, "entries of " + text(A(i, j)) + " and " + text(A(j, i)) + " across the diagonal",
            "a symmetric matrix, positive semidefinite");
      }
    }
  }
}

bool positive_by_size(const double* A, int n) noexcept {
  return kernels::with_size(n, [&]<int N>() { return kernels::is_positive<N>(A, n); });
}

}  // namespace

void check_covariance(const MatrixView& A, Eigen::Index n, const std::string& name) {
  if (A.rows() != n || A.cols() != n) {
    throw InvalidArgument(name, sizes(A), "(" + std::to_string(n) + ", " + std::to_string(n) + ")");
  }
  if (!A.allFinite()) {
    throw InvalidArgument(name, "NaN or infinity", "finite numbers");
  }
  check_symmetric(A, name);
  kernels::Scratch copy;
  copy_columns(A, copy.data());
  const int size = static_cast<int>(n);
  kernels::symmetrize<0>(copy.data(), size);
  if (!positive_by_size(copy.data(), size) &&
      !kernels::keep_positive<0>(copy.data(), size, kCovarianceTolerance)) {
    throw InvalidArgument(name, "a matrix with a negative eigenvalue",
                          "a symmetric matrix, positive semidefinite");
  }
}

void symmetrize(MatrixSpan A) noexcept {
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    for (Eigen::Index i = j + 1; i < A.rows(); ++i) {
      A(i, j) = A(j, i) = 0.5 * (A(i, j) + A(j, i));
    }
  }
}

bool is_positive(const MatrixView& A) noexcept {
  kernels::Scratch copy;
  copy_columns(A, copy.data());
  return positive_by_size(copy.data(), static_cast<int>(A.rows()));
}

// A view is passed by value.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
bool keep_positive(MatrixSpan A, double most) noexcept {
  kernels::Scratch copy;
  copy_columns(A, copy.data());
  if (positive_by_size(copy.data(), static_cast<int>(A.rows()))) {
    return true;
  }
  const bool kept = kernels::keep_positive<0>(copy.data(), static_cast<int>(A.rows()), most);
  if (kept) {
    write_columns(copy.data(), A);
  }
  return kept;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param)
bool keep_positive(MatrixSpan A, const VectorView& sizes) noexcept {
  const auto n = static_cast<int>(A.rows());
  kernels::Scratch copy;
  copy_columns(A, copy.data());
  if (positive_by_size(copy.data(), n)) {
    return true;
  }
  double fraction = 16.0 * n * kEpsilon;
  // Entries are at most the geometric mean of two sizes: n of them outweigh all others in a row.
  while (!kernels::is_positive<0>(copy.data(), n)) {
    if (fraction > 4.0 * n) {
      return false;
    }
    copy_columns(A, copy.data());
    for (Eigen::Index k = 0; k < A.rows(); ++k) {
      copy[static_cast<std::size_t>(k * A.rows() + k)] += fraction * sizes[k];
    }
    fraction *= 4.0;
  }
  write_columns(copy.data(), A);
  return true;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param)
bool cholesky(const MatrixView& A, MatrixSpan L) noexcept {
  kernels::Scratch copy;
  copy_columns(A, copy.data());
  const bool positive = kernels::cholesky<0>(copy.data(), copy.data(), static_cast<int>(A.rows()));
  write_columns(copy.data(), L);
  return positive;
}

// Householder's reflections, row by row, each of which leaves W W^T as it is.
void lower_factor(double* W, int n, int k) noexcept {
  for (int i = 0; i < n; ++i) {
    double* const row = W + i * k;
    const double norm = Eigen::Map<const Eigen::VectorXd>(row + i, k - i).stableNorm();
    if (norm == 0.0) {
      continue;
    }
    const double first = row[i] > 0.0 ? -norm : norm;
    const double pivot = row[i] - first;  // of the reflection's vector (pivot, row[i + 1], ...)
    for (int l = i + 1; l < n; ++l) {
      double* const other = W + l * k;
      double product = other[i] * pivot;
      for (int j = i + 1; j < k; ++j) {
        product += other[j] * row[j];
      }
      const double factor = product / (first * pivot);
      other[i] += factor * pivot;
      for (int j = i + 1; j < k; ++j) {
        other[j] += factor * row[j];
      }
    }
    row[i] = first;
    std::fill(row + i + 1, row + k, 0.0);
  }
  for (int i = 0; i < n; ++i) {  // the factor with a positive diagonal
    if (W[i * k + i] < 0.0) {
      for (int l = i; l < n; ++l) {
        W[l * k + i] = -W[l * k + i];
      }
    }
  }
}

// Gill, Golub, Murray & Saunders 1974, method C1, column by column.
bool cholesky_update(MatrixSpan L, const VectorView& v, double weight) noexcept {
  const Eigen::Index n = L.rows();
  kernels::Scratch kept;
  copy_columns(L, kept.data());
  std::array<double, kernels::kMostRows> w;
  std::copy_n(v.data(), n, w.data());
  double b = 1.0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double d = L(k, k);
    double* const rest = w.data();
    const double p = rest[k];
    if (p == 0.0) {
      continue;
    }
    const double square = d * d + weight / b * p * p;
    // A pivot that rounding alone could have left is none.
    if (!(square > static_cast<double>(n) * kEpsilon * d * d && std::isfinite(square))) {
      write_columns(kept.data(), L);
      return false;
    }
    const double fresh = std::sqrt(square);
    const double ratio = d > 0.0 ? p / d : 0.0;
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const double before = L(i, k);
      const double left = rest[i] - ratio * before;
      L(i, k) = d > 0.0 ? fresh / d * before + weight / b * p / fresh * left
                        : weight / b * p / fresh * rest[i];
      rest[i] = d > 0.0 ? left : rest[i];
    }
    L(k, k) = fresh;
    b = d > 0.0 ? b + weight * p * p / (d * d) : b;
    if (d == 0.0) {
      return true;  // all of the rank-one term is in this column
    }
  }
  return true;
}

}  // namespace thing_kin
