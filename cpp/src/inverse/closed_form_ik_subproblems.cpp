#include "closed_form_ik_subproblems.hpp"

#include <algorithm>
#include <complex>
#include <numbers>

namespace thing_kin::closed_form {

namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;

/// |N (cos, sin) + n|^2 - 1 as constant + (a1, b1) . (cos, sin) + (a2, b2) . (cos 2x, sin 2x).
struct Harmonics {
  double a0, a1, b1, a2, b2;

  Harmonics(const Eigen::Matrix2d& N, const Eigen::Vector2d& n) {
    const Eigen::Matrix2d Q = N.transpose() * N;
    const Eigen::Vector2d r = N.transpose() * n;
    a0 = n.squaredNorm() - 1.0 + 0.5 * (Q(0, 0) + Q(1, 1));
    a1 = 2.0 * r[0];
    b1 = 2.0 * r[1];
    a2 = 0.5 * (Q(0, 0) - Q(1, 1));
    b2 = Q(0, 1);
  }

  double size() const { return std::abs(a0) + std::hypot(a1, b1) + std::hypot(a2, b2); }

  double value(double c, double s) const {
    return a0 + a1 * c + b1 * s + a2 * (c * c - s * s) + b2 * 2.0 * s * c;
  }
  double slope(double c, double s) const {
    return b1 * c - a1 * s + 2.0 * (b2 * (c * c - s * s) - a2 * 2.0 * s * c);
  }
};

/// All roots of a polynomial of degree four at once, by Aberth's iteration.
std::array<Complex, 4> quartic(const std::array<Complex, 5>& p) {
  std::array<Complex, 4> z;
  for (std::size_t i = 0; i < 4; ++i) {
    z[i] = std::polar(1.0 + 0.1 * static_cast<double>(i), 0.4 + 1.6 * static_cast<double>(i));
  }
  for (int iteration = 0; iteration < 60; ++iteration) {
    double largest = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Complex x = z[i];
      const Complex value = (((p[4] * x + p[3]) * x + p[2]) * x + p[1]) * x + p[0];
      const Complex slope = ((4.0 * p[4] * x + 3.0 * p[3]) * x + 2.0 * p[2]) * x + p[1];
      if (value == 0.0) {
        continue;
      }
      Complex others = 0.0;
      for (std::size_t j = 0; j < 4; ++j) {
        others += j == i || z[j] == x ? Complex(0.0) : 1.0 / (x - z[j]);
      }
      const Complex step = value / (slope - value * others);
      if (!std::isfinite(step.real()) || !std::isfinite(step.imag())) {
        continue;
      }
      z[i] -= step;
      largest = std::max(largest, std::abs(step) / std::max(1.0, std::abs(z[i])));
    }
    if (largest < 1e-15) {
      break;
    }
  }
  return z;
}

/// Newton's steps on the circle, each kept only if it brings the value nearer to zero.
Angle refined(const Harmonics& f, double x) {
  Angle at{std::cos(x), std::sin(x)};
  for (int i = 0; i < 4; ++i) {
    const double value = f.value(at.cos, at.sin);
    const double step = -value / f.slope(at.cos, at.sin);
    if (!(std::abs(step) < 0.1)) {
      break;
    }
    const Angle next = at * Angle{std::cos(step), std::sin(step)};
    if (!(std::abs(f.value(next.cos, next.sin)) < std::abs(value))) {
      break;
    }
    at = next;
  }
  return normalized(at.cos, at.sin);
}

void add(const Harmonics& f, double size, const Angle& angle, QuarticRoots& roots) {
  const auto i = static_cast<std::size_t>(roots.count++);
  roots.angle[i] = angle;
  const double value = std::abs(f.value(angle.cos, angle.sin));
  roots.excess[i] = value <= 1e-13 * size ? 0.0 : value;
  roots.separation[i] = std::abs(f.slope(angle.cos, angle.sin)) / size;
}

}  // namespace

QuarticRoots solve_quartic(const Eigen::Matrix2d& N, const Eigen::Vector2d& n) noexcept {
  constexpr double kNearCircle = 1e-3;  // a double root is off the circle by the root of its error
  const Harmonics f(N, n);
  const double size = f.size();
  const double leading = std::hypot(f.a2, f.b2);
  QuarticRoots roots;
  if (leading <= 1e-12 * size || !(size > 0.0)) {
    const Roots two = solve_linear(f.a1, f.b1, -f.a0, size);
    roots.free = two.free;
    for (const Angle& angle : two.angle) {
      add(f, size, angle, roots);
    }
    return roots;
  }
  const Complex p4(0.5 * f.a2, -0.5 * f.b2);
  const Complex p3(0.5 * f.a1, -0.5 * f.b1);
  std::array<Complex, 4> z = quartic({std::conj(p4), std::conj(p3), f.a0, p3, p4});
  const auto off = [](const Complex& root) { return std::abs(std::log(std::abs(root))); };
  std::ranges::sort(z,
                    [](const Complex& a, const Complex& b) { return std::arg(a) < std::arg(b); });
  const bool any = std::ranges::any_of(z, [&](auto& r) { return off(r) < kNearCircle; });
  for (const Complex& root : z) {
    if (!any || off(root) < kNearCircle) {
      add(f, size, refined(f, std::arg(root)), roots);
    }
  }
  return roots;
}

WristBend solve_bend(const Wrist& wrist, const Eigen::Vector3d& v) noexcept {
  const double across = std::sqrt(v[0] * v[0] + v[1] * v[1]);  // sine from axis 4 to axis 6
  WristBend bend;
  if (wrist.right_angles) {
    bend.angle = normalized(v[2], across);
    return bend;
  }
  // The spherical triangle of axes 4, 5 and 6. Heron's product keeps the digits of a small sine,
  // which the law of cosines loses.
  const double gamma = std::atan2(across, v[2]);
  const double half = 0.5 * (wrist.alpha + wrist.beta + gamma);
  const double product = 4.0 * std::sin(half) * std::sin(half - wrist.alpha) *
                         std::sin(half - wrist.beta) * std::sin(half - gamma);
  const double cosine = v[2] - wrist.cos_alpha * wrist.cos_beta;
  const double least = std::abs(wrist.alpha - wrist.beta);
  const double most = kPi - std::abs(kPi - wrist.alpha - wrist.beta);
  bend.excess = std::max(plus(least - gamma), plus(gamma - most));
  bend.angle = product > 0.0 ? normalized(cosine, std::sqrt(product))
                             : Angle{std::copysign(1.0, cosine), 0.0};
  return bend;
}

}  // namespace thing_kin::closed_form
