#pragma once

#include <cmath>

namespace thing_kin {

/// The entire functions phi_m(t) = sum_k (-t)^k / (2k + m)!, with t = theta^2. Every coefficient of
/// SO(3) and SE(3) is one of them or a ratio of two, free of cancellation and of a case for zero:
/// phi_1 = sin(theta)/theta, phi_2 = (1 - cos(theta))/theta^2, phi_3 = (theta -
/// sin(theta))/theta^3, and phi_{m+2} = (1/m! - phi_m)/t.
template <int m>
double phi(double t) {
  static_assert(m >= 1 && m <= 6);
  constexpr double kFactorial[] = {1, 1, 2, 6, 24, 120, 720};
  if (t < 1.0) {  // the recursion would cancel here; eleven terms reach rounding
    double term = 1.0 / kFactorial[m];
    double sum = term;
    for (int k = 1; k <= 10; ++k) {
      term *= -t / ((2 * k + m - 1) * (2 * k + m));
      sum += term;
    }
    return sum;
  }
  if constexpr (m == 1) {
    const double theta = std::sqrt(t);
    return std::sin(theta) / theta;
  } else if constexpr (m == 2) {
    const double theta = std::sqrt(t);
    const double half = std::sin(0.5 * theta);
    return 2.0 * half * half / t;
  } else {
    return (1.0 / kFactorial[m - 2] - phi<m - 2>(t)) / t;
  }
}

}  // namespace thing_kin
