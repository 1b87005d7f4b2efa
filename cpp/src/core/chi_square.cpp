#include "thing_kin/core/chi_square.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

struct Tails {
  double lower = 0.0, upper = 1.0;
  double density = 0.0;  // of the variable 2 t of which a, t are the incomplete gamma's arguments
};

// ln Gamma(a + 1) - (a ln a - a): what is left small of Stirling's formula, so that t^a e^-t /
// Gamma(a + 1) loses nothing to large logarithms that cancel.
double stirling_rest(double a) {
  constexpr double kHalfLogTwoPi = 0.91893853320467274178;
  if (a < 16.0) {
    return std::lgamma(a + 1.0) - (a * std::log(a) - a);
  }
  const double s = 1.0 / (a * a);
  const double series =
      (1.0 / 12 - s * (1.0 / 360 - s * (1.0 / 1260 - s * (1.0 / 1680 - s * (1.0 / 1188))))) / a;
  return kHalfLogTwoPi + 0.5 * std::log(a) + series;
}

// r - ln(1 + r) for r = t/a - 1, exact for small r and for small t too.
double log_excess(double a, double t) {
  const double r = (t - a) / a;
  if (std::abs(r) > 0.1) {
    return r - std::log(t / a);
  }
  double sum = 0.0;
  double power = r * r;
  for (int k = 2; k <= 20; ++k, power *= -r) {
    sum += power / k;
  }
  return sum;
}

// t^a e^-t / Gamma(a + 1)
double poisson_term(double a, double t) {
  return std::exp(-a * log_excess(a, t) - stirling_rest(a));
}

// Both tails of the regularized incomplete gamma function: the power series below its bulk, the
// continued fraction (modified Lentz) above.
Tails incomplete_gamma(double a, double t) {
  Tails tails;
  if (!(t > 0.0)) {
    return tails;
  }
  const double front = poisson_term(a, t);
  tails.density = 0.5 * front * a / t;
  if (t < a + 1.0) {
    double sum = 1.0;
    double term = 1.0;
    for (double k = 1.0; term > sum * 1e-17; k += 1.0) {
      term *= t / (a + k);
      sum += term;
    }
    tails.lower = std::min(1.0, front * sum);
    tails.upper = 1.0 - tails.lower;
    return tails;
  }
  constexpr double kTiny = 1e-300;
  double b = t + 1.0 - a;
  double c = 1.0 / kTiny;
  double d = 1.0 / b;
  double fraction = d;
  for (int i = 1; i < 100'000; ++i) {
    const auto k = static_cast<double>(i);
    const double numerator = -k * (k - a);
    b += 2.0;
    d = numerator * d + b;
    c = b + numerator / c;
    d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
    c = std::abs(c) < kTiny ? kTiny : c;
    fraction *= d * c;
    if (std::abs(d * c - 1.0) < 1e-16) {
      break;
    }
  }
  tails.upper = std::min(1.0, front * a * fraction);
  tails.lower = 1.0 - tails.upper;
  return tails;
}

// Wilson and Hilferty's cube of a normal quantile, the latter by its crudest formula.
double first_guess(double probability, double dof) {
  const double tail = std::min(probability, 1.0 - probability);
  const double s = std::sqrt(-2.0 * std::log(std::max(tail, 1e-300)));
  const double normal = s - (2.30753 + 0.27061 * s) / (1.0 + s * (0.99229 + 0.04481 * s));
  const double z = probability < 0.5 ? -normal : normal;
  const double spread = 2.0 / (9.0 * dof);
  const double cube = 1.0 - spread + z * std::sqrt(spread);
  return cube > 0.05 ? dof * cube * cube * cube : 0.0;
}

}  // namespace

double chi_square_probability(double x, int dof) {
  return incomplete_gamma(0.5 * dof, 0.5 * x).lower;
}

double chi_square_quantile(double probability, int dof) {
  if (!(probability >= 0.0 && probability <= 1.0)) {
    throw InvalidArgument("probability", text(probability), "a number from 0 to 1");
  }
  if (dof < 1 || dof > 1'000'000) {
    throw InvalidArgument("dof", std::to_string(dof), "a whole number from 1 to 1000000");
  }
  if (probability == 0.0 || probability == 1.0) {
    return probability == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
  }
  const double a = 0.5 * dof;
  const bool small = probability < 0.5;
  const double goal = small ? probability : 1.0 - probability;
  // Far below the bulk the series' first term alone, in logarithms.
  const double least = std::exp((std::log(probability) + std::lgamma(a + 1.0)) / a) * 2.0;
  double x = std::max(first_guess(probability, dof), least);
  double low = 0.0;
  double high = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 200; ++i) {
    const Tails tails = incomplete_gamma(a, 0.5 * x);
    const double excess = small ? tails.lower - goal : goal - tails.upper;
    (excess > 0.0 ? high : low) = x;
    // Newton's step on the tail's logarithm, where it is nearly straight; bisection if it leaves.
    const double tail = small ? tails.lower : tails.upper;
    const double slope = (small ? 1.0 : -1.0) * tails.density;
    const double newton = x - std::log(tail / goal) * tail / slope;
    const double middle = std::isinf(high) ? 2.0 * x : 0.5 * (low + high);
    const double next = newton > low && newton < high ? newton : middle;
    if (std::abs(next - x) <= 2e-16 * x || excess == 0.0) {
      return excess == 0.0 ? x : next;
    }
    x = next;
  }
  return x;
}

}  // namespace thing_kin
