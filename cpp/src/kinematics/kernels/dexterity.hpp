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

inline Six six(const Twist& t) { return Six{t.v.x, t.v.y, t.v.z, t.w.x, t.w.y, t.w.z, 0.0, 0.0}; }

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
  Nine operator-(const Nine& o) const { return {x - o.x, y - o.y, z - o.z}; }
};

/// sum_m P_m . d^2 J_m / dq_k dq_l for k <= l in chain order, P fixed covectors.
///
/// Position: the third derivative of p by a <= b <= c is w_a x (w_b x v_c). Axis: that of w_m by
/// k <= l < m is w_k x (w_l x w_m), and zero else. x . (a x (b x c)) = a^T (c x^T - (x . c) I) b is
/// linear in each: sums over m are running matrices.
struct SecondDerivative {
  Nine outer[kMaxDof], between[kMaxDof];
  Three inner[kMaxDof];

  SecondDerivative(const Twist* J, const Twist* P, int count) {
    Nine sum;
    for (int m = count - 1; m >= 0; --m) {
      sum.add(1.0, J[m].v, P[m].v);
      outer[m] = sum;  // w_m itself turns by joints before it only
      sum.add(1.0, J[m].w, P[m].w);
    }
    Nine passed;
    Three torque{};
    for (int m = 0; m < count; ++m) {
      between[m] = passed;
      inner[m] = torque;
      passed.add(-1.0, J[m].w, P[m].v);
      torque = torque + cross(P[m].v, J[m].w);
    }
  }

  double operator()(const Twist* J, int k, int l) const {
    const Three far = outer[l] * J[l].w + (between[l] - between[k]) * J[l].v;
    return dot(J[k].w, far) + dot(inner[k], cross(J[k].w, J[l].v));
  }
};

/// dJ_m/dq_k: an inner joint turns everything further out; an outer one moves the point.
inline Twist derivative(const Twist* J, int m, int k) {
  if (m < k) {
    return {cross(J[m].w, J[k].v), {}};
  }
  return {cross(J[k].w, J[m].v), cross(J[k].w, J[m].w)};
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
      factor[j][i] = 0.5 * a.manipulability / (lambda[i] * lambda[j]);
    }
  }
  const int extremes[] = {most, least};
  for (const int e : extremes) {
    const double share = a.condition_number / lambda[e];
    for (int i = 0; i < 6; ++i) {
      const double gap = magnitude(lambda[e] - lambda[i]);
      const double floor = DexterityArguments::kLeastGap * lambda[e];
      factor[e][i] += i == e ? 0.0 : share / (gap > floor ? gap : floor);
    }
    factor[e][e] += (e == most ? -0.5 : 0.5) * share / lambda[e];
  }
}

/// What the eigenvalues do as joint k moves: turned = U^T dJ W^1/2, rate = U^T dA U.
struct Rate {
  Six turned[kMaxDof];
  Six rate[6];
};

inline void differentiate(const WeightedColumns& c, int count, int k, const Six* rows, const Six* B,
                          Rate& out) {
  Six half[6] = {};
  for (int m = 0; m < count; ++m) {
    const Twist d = derivative(c.J, m, k);
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
      out.rate[j][i] = half[j][i] + half[i][j];
    }
    out.rate[j][6] = 0.0;
    out.rate[j][7] = 0.0;
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
      share[i] = (kappa * a.condition_number - 0.5 * a.manipulability) / s.lambda[i];
      rows[i] = Six{s.u[0][i], s.u[1][i], s.u[2][i], s.u[3][i], s.u[4][i], s.u[5][i], 0.0, 0.0};
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

/// One row of the second derivative, but for what P gives: for each l up to k.
inline void bend(const DexterityArguments& a, const Six& share, const Six* factor,
                 const Rate* rates, int k, double* row) {
  Six scaled[kMaxDof];
  Six bent[6];
  for (int m = 0; m < a.count; ++m) {
    scaled[m] = (2.0 * share) * rates[k].turned[m];
  }
  for (int j = 0; j < 6; ++j) {
    bent[j] = factor[j] * rates[k].rate[j];
  }
  for (int l = a.first; l <= k; ++l) {
    Six sum{};
    for (int m = 0; m < a.count; ++m) {
      sum += scaled[m] * rates[l].turned[m];
    }
    for (int j = 0; j < 6; ++j) {
      sum += bent[j] * rates[l].rate[j];
    }
    row[l] = sum_of(sum);
  }
}

inline void log_dexterity(const DexterityArguments& a, double* values, double* gradient,
                          double* hessian) {
  WeightedColumns c(a);
  const Spectrum<true> s(c.A);
  int most = 0;
  int least = 0;
  summarize(s, values, most, least);
  if (!(values[1] > DexterityArguments::kSingular * values[0])) {
    return;
  }
  const EigenAxes axes(a, c, s, most, least);
  const SecondDerivative second(c.J, axes.P, a.count);
  Six factor[6];
  curvature_factors(a, s.lambda, most, least, factor);
  Rate rates[kMaxDof];
  for (int k = a.first; k < a.count; ++k) {
    differentiate(c, a.count, k, axes.rows, axes.B, rates[k]);
    double slope = 0.0;
    for (int i = 0; i < 6; ++i) {
      slope += axes.share[i] * rates[k].rate[i][i];
    }
    gradient[a.order[k]] = slope;
    double row[kMaxDof];
    bend(a, axes.share, factor, rates, k, row);
    for (int l = a.first; l <= k; ++l) {
      const double value = 2.0 * second(c.J, l, k) + row[l];
      hessian[a.order[k] + a.stride * a.order[l]] = value;
      hessian[a.order[l] + a.stride * a.order[k]] = value;
    }
  }
}

inline void dexterity_spectrum(const DexterityArguments& a, double* values) {
  WeightedColumns c(a);
  const Spectrum<false> s(c.A);
  int most = 0;
  int least = 0;
  summarize(s, values, most, least);
}

}  // namespace thing_kin::THING_KIN_LEVEL
