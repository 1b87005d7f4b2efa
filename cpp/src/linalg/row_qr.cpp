#include "thing_kin/linalg/row_qr.hpp"

#include <algorithm>
#include <cmath>

namespace thing_kin {

namespace {

template <int Length>
using Padded = Eigen::Map<Eigen::Matrix<double, Length, 1>, Eigen::Aligned32>;
template <int Length>
using ConstPadded = Eigen::Map<const Eigen::Matrix<double, Length, 1>, Eigen::Aligned32>;

// Calls function(integral constant) with the shortest padded length for f.
template <typename Function>
void with_length(int f, Function function) {
  if (f <= 4) {
    function(std::integral_constant<int, 4>());
  } else if (f <= 8) {
    function(std::integral_constant<int, 8>());
  } else if (f <= 12) {
    function(std::integral_constant<int, 12>());
  } else {
    function(std::integral_constant<int, kMaxDof>());
  }
}

// x <- (I - beta v v^T) x.
template <int Length>
void reflect(const double* v, double beta, double* x) {
  const ConstPadded<Length> reflector(v);
  Padded<Length> vector(x);
  vector -= (beta * reflector.dot(vector)) * reflector;
}

}  // namespace

void RowQr::factor(const SmallMatrix& A) noexcept {
  m_ = static_cast<int>(A.rows());
  f_ = static_cast<int>(A.cols());
  with_length(f_, [&](auto length) {
    for (int j = 0; j < m_; ++j) {
      Padded<length()>(v_[j]).setZero();
    }
    const double* entry = A.data();
    for (int i = 0; i < f_; ++i) {
      for (int j = 0; j < m_; ++j) {
        v_[j][i] = *entry++;
      }
    }
    reflect_rows<length()>();
  });
  invert_r();
}

// The columns of v, rows of A at first, become the reflectors, zero above their own row.
template <int Length>
void RowQr::reflect_rows() noexcept {
  for (int j = 0; j < m_; ++j) {
    double* v = v_[j];
    for (int i = 0; i < j; ++i) {
      r_[j][i] = v[i];
      v[i] = 0.0;
    }
    const double norm = ConstPadded<Length>(v).norm();
    const double pivot = v[j];
    const double diagonal = -std::copysign(norm, pivot);
    r_[j][j] = diagonal;
    v[j] = pivot - diagonal;
    const double half_square = norm * (norm + std::abs(pivot));
    beta_[j] = half_square > 0.0 ? 1.0 / half_square : 0.0;
    for (int k = j + 1; k < m_; ++k) {
      reflect<Length>(v, beta_[j], v_[k]);
    }
  }
}

void RowQr::invert_r() noexcept {
  double square = 0.0;
  for (int j = 0; j < m_; ++j) {
    if (r_[j][j] == 0.0) {
      least_ = 0.0;
      return;
    }
    inverse_[j][j] = 1.0 / r_[j][j];
    for (int i = j - 1; i >= 0; --i) {
      double sum = 0.0;
      for (int k = i + 1; k <= j; ++k) {
        sum += r_[k][i] * inverse_[j][k];
      }
      inverse_[j][i] = -sum * inverse_[i][i];
    }
    for (int i = 0; i <= j; ++i) {
      square += inverse_[j][i] * inverse_[j][i];
    }
  }
  least_ = square < 1e300 ? 1.0 / std::sqrt(square) : 0.0;
}

void RowQr::solve_r(double* y) const noexcept {
  for (int i = m_ - 1; i >= 0; --i) {
    for (int j = i + 1; j < m_; ++j) {
      y[i] -= r_[j][i] * y[j];
    }
    y[i] *= inverse_[i][i];
  }
}

void RowQr::solve_r_transposed(double* y) const noexcept {
  for (int i = 0; i < m_; ++i) {
    for (int j = 0; j < i; ++j) {
      y[i] -= r_[i][j] * y[j];
    }
    y[i] *= inverse_[i][i];
  }
}

void RowQr::lift(const double* y, double* x) const noexcept {
  with_length(f_, [&](auto length) {
    alignas(64) double padded[length()] = {};
    for (int i = 0; i < m_; ++i) {
      padded[i] = y[i];
    }
    for (int j = m_ - 1; j >= 0; --j) {
      reflect<length()>(v_[j], beta_[j], padded);
    }
    for (int i = 0; i < f_; ++i) {
      x[i] = padded[i];
    }
  });
}

void RowQr::apply_q_transposed(double* x) const noexcept {
  with_length(f_, [&](auto length) {
    alignas(64) double padded[length()] = {};
    for (int i = 0; i < f_; ++i) {
      padded[i] = x[i];
    }
    for (int j = 0; j < m_; ++j) {
      reflect<length()>(v_[j], beta_[j], padded);
    }
    for (int i = 0; i < f_; ++i) {
      x[i] = padded[i];
    }
  });
}

void RowQr::columns_of_q(int first, int count, SmallMatrix& V) const noexcept {
  V.resize(f_, count);
  with_length(f_, [&](auto length) {
    alignas(64) double padded[kMaxDof][length()];
    for (int column = 0; column < count; ++column) {
      Padded<length()>(padded[column]).setZero();
      padded[column][first + column] = 1.0;
    }
    // Reflector j is zero above row j: those below a column's own row do nothing to it. The columns
    // take turns, so that one need not wait for the other.
    for (int j = std::min(first + count, m_) - 1; j >= 0; --j) {
      for (int column = std::max(0, j - first); column < count; ++column) {
        reflect<length()>(v_[j], beta_[j], padded[column]);
      }
    }
    for (int column = 0; column < count; ++column) {
      double* const to = &V(0, column);
      for (int i = 0; i < f_; ++i) {
        to[i] = padded[column][i];
      }
    }
  });
}

void RowQr::row_space(SmallMatrix& V1) const noexcept { columns_of_q(0, m_, V1); }

void RowQr::null_space(SmallMatrix& V2) const noexcept {
  if (f_ == m_) {
    V2.resize(f_, 0);
  } else {
    columns_of_q(m_, f_ - m_, V2);
  }
}

}  // namespace thing_kin
