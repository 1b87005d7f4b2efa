#pragma once

#include "column.hpp"

namespace thing_kin::THING_KIN_LEVEL {

/// x <- A^-1 x by A = L D L^T, of which the lower triangle is given in rows and destroyed. No
/// eigenvalue is below `least` > 0, and so but for rounding no pivot is.
inline void solve_symmetric(double A[6][6], double least, double x[6]) {
  double inverse[6];
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    inverse[k] = 1.0 / (A[k][k] > least ? A[k][k] : least);
#pragma GCC unroll 6
    for (int i = k + 1; i < 6; ++i) {
      const double factor = A[i][k] * inverse[k];
#pragma GCC unroll 6
      for (int j = k + 1; j <= i; ++j) {
        A[i][j] -= factor * A[j][k];
      }
      x[i] -= factor * x[k];
    }
  }
#pragma GCC unroll 6
  for (int k = 5; k >= 0; --k) {
#pragma GCC unroll 6
    for (int i = k + 1; i < 6; ++i) {
      x[k] -= A[i][k] * x[i];
    }
    x[k] *= inverse[k];
  }
}

/// Three columns of a (3, 3) matrix.
struct Matrix3 {
  Column x, y, z;
};

inline void read(const double* columns, Matrix3& to) {
  read(columns, to.x);
  read(columns + 4, to.y);
  read(columns + 8, to.z);
}

inline Column operator*(const Matrix3& M, const double* v) {
  return v[0] * M.x + v[1] * M.y + v[2] * M.z;
}

/// The lower triangle of sum_j m_j c_j c_j^T + lambda I, in rows; c = [linear v; angular w].
inline void normal_matrix(const double* J, const double* mobility, int n, const Matrix3& linear,
                          const Matrix3& angular, double lambda, double A[6][6]) {
  Column vv[3] = {};
  Column wv[3] = {};
  Column ww[3] = {};
  for (int j = 0; j < n; ++j) {
    const Column v = linear * (J + 6 * j);
    const Column w = angular * (J + 6 * j + 3);
    const Column mv = mobility[j] * v;
    const Column mw = mobility[j] * w;
    for (int k = 0; k < 3; ++k) {
      vv[k] = vv[k] + v[k] * mv;
      wv[k] = wv[k] + v[k] * mw;
      ww[k] = ww[k] + w[k] * mw;
    }
  }
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) {
      A[i][k] = vv[k][i];
      A[3 + i][k] = wv[k][i];
      A[3 + i][3 + k] = ww[k][i];
    }
    A[k][k] += lambda;
    A[3 + k][3 + k] += lambda;
  }
}

}  // namespace thing_kin::THING_KIN_LEVEL
