#pragma once

#include "kernels.hpp"
#include "spectrum.hpp"

namespace thing_kin::THING_KIN_LEVEL {

struct Three {
  double x, y, z;
};

inline Three operator+(const Three& a, const Three& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Three operator-(const Three& a, const Three& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Three operator*(double s, const Three& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Three& a, const Three& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Three cross(const Three& a, const Three& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A twist: a joint's column, [linear v; angular w].
struct Twist {
  Three v, w;
};

inline Six six(const Twist& t) { return Six{t.v.x, t.v.y, t.v.z, t.w.x, t.w.y, t.w.z}; }

/// A (3, 3) matrix, rows.
struct Nine {
  Three x{}, y{}, z{};

  /// += a b^T - (a . b) I, sign * that.
  void add(double sign, const Three& a, const Three& b) {
    const double ab = dot(a, b);
    x = x + sign * (a.x * b - Three{ab, 0.0, 0.0});
    y = y + sign * (a.y * b - Three{0.0, ab, 0.0});
    z = z + sign * (a.z * b - Three{0.0, 0.0, ab});
  }
  Three operator*(const Three& a) const { return {dot(x, a), dot(y, a), dot(z, a)}; }
};

/// sum_m P_m . d^2 J_m / dq_k dq_l for k <= l in chain order, P fixed covectors.
///
/// Position: the third derivative of p by a <= b <= c is w_a x (w_b x v_c). Axis: that of w_m by
/// k <= l < m is w_k x (w_l x w_m), and zero else. x . (a x (b x c)) = a^T (c x^T - (x . c) I) b is
/// linear in each: sums over m are running matrices, and what they do to each joint one vector for
/// its part as the inner, one as the outer of a pair.
struct SecondDerivative {
  Three inner[kMaxDof], outer[kMaxDof];

  SecondDerivative(const Twist* J, const Twist* P, int count) {
    Nine sum;
    for (int m = count - 1; m >= 0; --m) {
      sum.add(1.0, J[m].v, P[m].v);
      outer[m] = sum * J[m].w;  // w_m itself turns by joints before it only
      sum.add(1.0, J[m].w, P[m].w);
    }
    Nine passed;
    Three torque{};
    for (int m = 0; m < count; ++m) {
      const Three& w = J[m].w;
      outer[m] = outer[m] + passed * J[m].v;
      inner[m] = cross(torque, w) - (w.x * passed.x + w.y * passed.y + w.z * passed.z);
      passed.add(-1.0, w, P[m].v);
      torque = torque + cross(P[m].v, w);
    }
  }

  double operator()(const Twist* J, int k, int l) const {
    return dot(J[k].w, outer[l]) + dot(inner[k], J[l].v);
  }
};

/// dJ_m/dq_k: an inner joint turns everything further out; an outer one moves the point.
inline Twist derivative(const Twist* J, int m, int k) {
  if (m < k) {
    return {cross(J[m].w, J[k].v), {}};
  }
  return {cross(J[k].w, J[m].v), cross(J[k].w, J[m].w)};
}

/// sum_k z_k dJ_m/dq_k of all joints m, with z_k for those from `first` on, in chain order.
inline void derivative_along(const Twist* J, const double* z, int first, int count, Twist* out) {
  Three shift{};  // of a point beyond the last joint
  for (int k = count - 1; k >= 0; --k) {
    out[k] = {cross(J[k].w, shift), {}};
    if (k >= first) {
      shift = shift + z[k] * J[k].v;
    }
  }
  Three turn{};
  for (int m = first; m < count; ++m) {
    turn = turn + z[m] * J[m].w;
    out[m].v = out[m].v + cross(turn, J[m].v);
    out[m].w = cross(turn, J[m].w);
  }
}

/// 2 sum_m P_m . dJ_m/dq_k for all k, P fixed covectors.
inline void slopes(const Twist* J, const Twist* P, int count, double* slope) {
  Three moment{};
  for (int k = count - 1; k >= 0; --k) {
    moment = moment + cross(J[k].v, P[k].v) + cross(J[k].w, P[k].w);
    slope[k] = 2.0 * dot(J[k].w, moment);
  }
  Three force{};
  for (int k = 0; k < count; ++k) {
    slope[k] += 2.0 * dot(J[k].v, force);
    force = force + cross(P[k].v, J[k].w);
  }
}

/// Columns of J in chain order, with their weights, and A = J W J^T.
struct WeightedColumns {
  Twist J[kMaxDof];
  double weight[kMaxDof];
  Six column[kMaxDof];  // weighted
  Six A[6] = {};

  explicit WeightedColumns(const DexterityArguments& a) {
    for (int m = 0; m < a.count; ++m) {
      const double* c = a.J + 6 * a.order[m];
      J[m] = {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}};
      weight[m] = a.weights == nullptr ? 1.0 : a.weights[a.order[m]];
      column[m] = weight[m] * six(J[m]);
      for (int i = 0; i < 6; ++i) {
        A[i] += column[m][i] * column[m];
      }
    }
  }
};

/// The extreme eigenvalues, and the product of all.
template <bool kVectors>
inline void summarize(const Spectrum<kVectors>& s, double* values, int& most, int& least) {
  most = 0;
  least = 0;
  values[2] = 1.0;
  for (int i = 0; i < 6; ++i) {
    most = s.lambda[i] > s.lambda[most] ? i : most;
    least = s.lambda[i] < s.lambda[least] ? i : least;
    values[2] *= s.lambda[i];
  }
  values[0] = s.lambda[most];
  values[1] = s.lambda[least];
}

/// What the second derivative of w_kappa log kappa - w_M log M has beyond that of A is a quadratic
/// form in the entries of U^T dA U: their factors. log det A has no gaps; the largest and smallest
/// eigenvalue have each the gaps to the others.
inline void curvature_factors(const DexterityArguments& a, const double* lambda, int most,
                              int least, Six factor[6]) {
  for (int j = 0; j < 6; ++j) {
    factor[j] = Six{};
    for (int i = 0; i < 6; ++i) {
      factor[j].set(i, 0.5 * a.manipulability / (lambda[i] * lambda[j]));
    }
  }
  const int extremes[] = {most, least};
  for (const int e : extremes) {
    const double share = a.condition_number / lambda[e];
    for (int i = 0; i < 6; ++i) {
      const double gap = magnitude(lambda[e] - lambda[i]);
      const double floor = DexterityArguments::kLeastGap * lambda[e];
      const double own = (e == most ? -0.5 : 0.5) * share / lambda[e];
      factor[e].set(i, factor[e][i] + (i == e ? own : share / (gap > floor ? gap : floor)));
    }
  }
}

/// What the eigenvalues do as J changes by dJ: turned = U^T dJ W^1/2, rate = U^T dA U.
struct Rate {
  Six turned[kMaxDof];
  Six rate[6];
};

inline void differentiate(const WeightedColumns& c, const Twist* dJ, int count, const Six* rows,
                          const Six* B, Rate& out) {
  Six half[6] = {};
  for (int m = 0; m < count; ++m) {
    const Twist& d = dJ[m];
    Six t = d.v.x * rows[0] + d.v.y * rows[1] + d.v.z * rows[2];
    t += d.w.x * rows[3] + d.w.y * rows[4] + d.w.z * rows[5];
    t *= c.weight[m];
    out.turned[m] = t;
    for (int j = 0; j < 6; ++j) {
      half[j] += B[m][j] * t;
    }
  }
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 6; ++i) {
      out.rate[j].set(i, half[j][i] + half[i][j]);
    }
  }
}

inline Twist covector(const Six* u, const Six& along, double weight) {
  Six p{};
  for (int i = 0; i < 6; ++i) {
    p += along[i] * u[i];
  }
  p *= weight;
  return {{p[0], p[1], p[2]}, {p[3], p[4], p[5]}};
}

/// In the axes of the eigenvectors: J, what each eigenvalue counts, and the covectors that make
/// the second derivative of A count.
struct EigenAxes {
  Six share{};
  Six rows[6];
  Six B[kMaxDof];
  Twist P[kMaxDof];

  EigenAxes(const DexterityArguments& a, const WeightedColumns& c, const Spectrum<true>& s,
            int most, int least) {
    for (int i = 0; i < 6; ++i) {
      const double kappa = i == most ? 0.5 : i == least ? -0.5 : 0.0;
      share.set(i, (kappa * a.condition_number - 0.5 * a.manipulability) / s.lambda[i]);
      rows[i] = Six{s.u[0][i], s.u[1][i], s.u[2][i], s.u[3][i], s.u[4][i], s.u[5][i]};
    }
    for (int m = 0; m < a.count; ++m) {
      B[m] = Six{};
      for (int i = 0; i < 6; ++i) {
        B[m] += c.column[m][i] * rows[i];
      }
      P[m] = covector(s.u, share * B[m], c.weight[m]);
    }
  }
};

/// The second derivative by two motions, but for what P gives: for one, and each of the first.
inline void bend(int count, const Six& share, const Six* factor, const Rate* rates, int begin,
                 int k, double* row) {
  Six scaled[kMaxDof];
  Six bent[6];
  for (int m = 0; m < count; ++m) {
    scaled[m] = (2.0 * share) * rates[k].turned[m];
  }
  for (int j = 0; j < 6; ++j) {
    bent[j] = factor[j] * rates[k].rate[j];
  }
  for (int l = begin; l <= k; ++l) {
    Six sum{};
    for (int m = 0; m < count; ++m) {
      sum += scaled[m] * rates[l].turned[m];
    }
    for (int j = 0; j < 6; ++j) {
      sum += bent[j] * rates[l].rate[j];
    }
    row[l] = sum_of(sum);
  }
}

/// The eigenvalues, what each counts, and the gradient: what both forms of the second derivative
/// need.
struct DexterityState {
  WeightedColumns c;
  Spectrum<true> spectrum;
  bool regular;

  DexterityState(const DexterityArguments& a, double* values) : c(a), spectrum(c.A) {
    summarize(spectrum, values, most_, least_);
    regular = values[1] > DexterityArguments::kSingular * values[0];
  }

  EigenAxes axes(const DexterityArguments& a) const { return {a, c, spectrum, most_, least_}; }
  void factors(const DexterityArguments& a, Six factor[6]) const {
    curvature_factors(a, spectrum.lambda, most_, least_, factor);
  }

 private:
  int most_ = 0;
  int least_ = 0;
};

inline void write_gradient(const DexterityArguments& a, const Twist* J, const Twist* P,
                           double* gradient) {
  double slope[kMaxDof];
  slopes(J, P, a.count, slope);
  for (int k = a.first; k < a.count; ++k) {
    gradient[a.order[k]] = slope[k];
  }
}

inline void log_dexterity(const DexterityArguments& a, double* values, double* gradient,
                          double* hessian) {
  const DexterityState state(a, values);
  if (!state.regular) {
    return;
  }
  const WeightedColumns& c = state.c;
  const EigenAxes axes = state.axes(a);
  const SecondDerivative second(c.J, axes.P, a.count);
  Six factor[6];
  state.factors(a, factor);
  write_gradient(a, c.J, axes.P, gradient);
  Rate rates[kMaxDof];
  for (int k = a.first; k < a.count; ++k) {
    Twist dJ[kMaxDof];
    for (int m = 0; m < a.count; ++m) {
      dJ[m] = derivative(c.J, m, k);
    }
    differentiate(c, dJ, a.count, axes.rows, axes.B, rates[k]);
    double row[kMaxDof];
    bend(a.count, axes.share, factor, rates, a.first, k, row);
    for (int l = a.first; l <= k; ++l) {
      const double value = 2.0 * second(c.J, l, k) + row[l];
      hessian[a.order[k] + a.stride * a.order[l]] = value;
      hessian[a.order[l] + a.stride * a.order[k]] = value;
    }
  }
}

/// S_z of z^T S z' = S_z . z' + S_z' . z, where S is the symmetric matrix of which `second` gives
/// the entries k <= l: those before the diagonal, which are sums on the way out, and half of it.
inline void half_along(const SecondDerivative& second, const Twist* J, const double* z, int first,
                       int count, double* out) {
  Three turn{};
  Three inner{};
  for (int m = first; m < count; ++m) {
    out[m] = dot(turn, second.outer[m]) + dot(inner, J[m].v) + 0.5 * z[m] * second(J, m, m);
    turn = turn + z[m] * J[m].w;
    inner = inner + z[m] * second.inner[m];
  }
}

inline void log_dexterity_along(const DexterityArguments& a, const double* Z, int width,
                                double* values, double* gradient, double* hessian) {
  const DexterityState state(a, values);
  if (!state.regular) {
    return;
  }
  const WeightedColumns& c = state.c;
  const EigenAxes axes = state.axes(a);
  const SecondDerivative second(c.J, axes.P, a.count);
  Six factor[6];
  state.factors(a, factor);
  write_gradient(a, c.J, axes.P, gradient);
  Rate rates[kMaxDof];
  double z[kMaxDof][kMaxDof];
  double half[kMaxDof][kMaxDof];
  for (int k = 0; k < width; ++k) {
    for (int m = a.first; m < a.count; ++m) {
      z[k][m] = Z[a.order[m] + a.stride * k];
    }
    Twist dJ[kMaxDof];
    derivative_along(c.J, z[k], a.first, a.count, dJ);
    differentiate(c, dJ, a.count, axes.rows, axes.B, rates[k]);
    double row[kMaxDof];
    bend(a.count, axes.share, factor, rates, 0, k, row);
    half_along(second, c.J, z[k], a.first, a.count, half[k]);
    for (int l = 0; l <= k; ++l) {
      double value = row[l];
      for (int m = a.first; m < a.count; ++m) {
        value += 2.0 * (half[k][m] * z[l][m] + half[l][m] * z[k][m]);
      }
      hessian[k + width * l] = value;
      hessian[l + width * k] = value;
    }
  }
}

/// tr S^8 of a symmetric (6, 6) matrix: of the eigenvalues' eighth powers.
inline double eighth_powers(const Six S[6]) {
  Six powers[2][6] = {};  // S^2, S^4
  for (int k = 0; k < 2; ++k) {
    const Six* const from = k == 0 ? S : powers[0];
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        powers[k][i] += from[i][j] * from[j];
      }
    }
  }
  Six sum{};
  for (int i = 0; i < 6; ++i) {
    sum += powers[1][i] * powers[1][i];
  }
  return sum_of(sum);
}

/// A positive definite (6, 6) matrix becomes its inverse (Gauss and Jordan); its determinant, or 0
/// if it is not positive definite in rounding.
inline double invert(Six A[6]) {
  double determinant = 1.0;
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    const Six unit{k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0,
                   k == 3 ? 1.0 : 0.0, k == 4 ? 1.0 : 0.0, k == 5 ? 1.0 : 0.0};
    const double pivot = A[k][k];
    if (!(pivot > 0.0)) {
      return 0.0;
    }
    determinant *= pivot;
    A[k] = (1.0 / pivot) * (A[k] + (1.0 - pivot) * unit);
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) {
      if (i != k) {
        const double factor = A[i][k];
        A[i] -= factor * (A[k] + unit);
      }
    }
  }
  return determinant;
}

inline double eighth_root(double x) { return __builtin_sqrt(__builtin_sqrt(__builtin_sqrt(x))); }

/// As dexterity_spectrum, with bounds instead of the extreme eigenvalues, by traces of powers.
inline void dexterity_bounds(const DexterityArguments& a, double* values) {
  WeightedColumns c(a);
  values[0] = eighth_root(eighth_powers(c.A));
  values[2] = invert(c.A);
  values[1] = values[2] > 0.0 ? 1.0 / eighth_root(eighth_powers(c.A)) : 0.0;
}

inline void dexterity_spectrum(const DexterityArguments& a, double* values) {
  WeightedColumns c(a);
  const Spectrum<false> s(c.A);
  int most = 0;
  int least = 0;
  summarize(s, values, most, least);
}

}  // namespace thing_kin::THING_KIN_LEVEL
