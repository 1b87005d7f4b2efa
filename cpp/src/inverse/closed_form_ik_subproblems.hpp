#pragma once

// The subproblems that closed forms come down to, and what the two kinds of arms share.

#include <array>
#include <cmath>

#include "thing_kin/inverse/closed_form_arm.hpp"
#include "thing_kin/inverse/closed_form_ik.hpp"

namespace thing_kin::closed_form {

/// A direction or length below this fraction of its scale is rounding: what it would fix is free.
inline constexpr double kFree = 1e-11;

/// Two branches closer than this (rad) are at a singularity.
inline constexpr double kSingularAngle = 1e-6;

/// One branch in canonical angles.
struct Branch {
  std::array<Angle, 6> angle;
  double excess = 0.0;  ///< by how much some equation can't be met; of the order of m or rad
  ArmSingularity singularity = ArmSingularity::kNone;
};

struct Branches {
  int count = 0;
  std::array<Branch, ClosedFormSolutions::kMost> branch;
};

/// What the solvers get: the canonical target, and where a free joint goes.
struct Question {
  Eigen::Matrix3d R;
  Eigen::Vector3d p;
  double length;            ///< of the arm
  const double* reference;  ///< canonical angles, 6
  Angle stay(int joint) const noexcept {
    return {std::cos(reference[joint]), std::sin(reference[joint])};
  }
};

inline Angle normalized(double cos, double sin) noexcept {
  const double squared = cos * cos + sin * sin;
  if (squared == 0.0) {
    return {};
  }
  const double scale = 1.0 / std::sqrt(squared);
  return {cos * scale, sin * scale};
}

inline double plus(double x) noexcept { return x > 0.0 ? x : 0.0; }

/// a cos(x) + b sin(x) = d: two angles, or where there is none the angle nearest to it, twice.
struct Roots {
  std::array<Angle, 2> angle;
  double excess = 0.0;
  double separation = 1.0;  ///< sine of half the angle between the two
  bool free = false;        ///< any angle does
};

/// Subproblem 4 of Elias and Wen.
inline Roots solve_linear(double a, double b, double d, double scale) noexcept {
  Roots roots;
  const double r2 = a * a + b * b;
  const double r = std::sqrt(r2);
  roots.excess = plus(std::abs(d) - r);
  if (r <= kFree * scale) {
    roots.free = true;
    return roots;
  }
  if (roots.excess > 0.0) {
    roots.separation = 0.0;
    const double sign = d > 0.0 ? 1.0 / r : -1.0 / r;
    roots.angle[0] = roots.angle[1] = {sign * a, sign * b};
    return roots;
  }
  const double w = std::sqrt((r - d) * (r + d));
  const double inverse = 1.0 / r2;
  roots.separation = w / r;
  roots.angle[0] = {(a * d + b * w) * inverse, (b * d - a * w) * inverse};
  roots.angle[1] = {(a * d - b * w) * inverse, (b * d + a * w) * inverse};
  return roots;
}

/// |a + b e^(i x)| = r for lengths a, b: the angle x >= 0, by its half, which loses nothing where
/// the links are in line. Subproblem 3 in the plane.
struct Knee {
  Angle angle;
  double excess = 0.0;
};

inline Knee solve_knee(double a, double b, double r) noexcept {
  const double opened = (r - (a - b)) * (r + (a - b));  // 4 a b cos^2(x/2)
  const double closed = ((a + b) - r) * ((a + b) + r);  // 4 a b sin^2(x/2)
  Knee knee;
  if (closed < 0.0) {
    knee.excess = r - (a + b);
    return knee;
  }
  if (opened < 0.0) {
    knee.excess = std::abs(a - b) - r;
    knee.angle = {-1.0, 0.0};
    return knee;
  }
  const double scale = 1.0 / (opened + closed);  // 4 a b
  knee.angle = {(opened - closed) * scale, 2.0 * std::sqrt(opened * closed) * scale};
  return knee;
}

/// The angles at which |N (cos, sin) + n| = 1, at most four: a quartic. Where there are fewer, the
/// angles that come near are among them, with an excess.
struct QuarticRoots {
  int count = 0;
  std::array<Angle, 4> angle;
  std::array<double, 4> excess{};
  std::array<double, 4> separation{};
  bool free = false;
};

void solve_arm(const ParallelArm& arm, const Question& question, Branches& out) noexcept;
void solve_arm(const SphericalArm& arm, const Question& question, Branches& out) noexcept;

QuarticRoots solve_quartic(const Eigen::Matrix2d& N, const Eigen::Vector2d& n) noexcept;

/// Angle 5 and the sine of the angle between axes 4 and 6, from axis 4 in the canonical tool, `v`.
struct WristBend {
  Angle angle;  ///< the one with a sine >= 0; the other has the opposite sine
  double excess = 0.0;
};

WristBend solve_bend(const Wrist& wrist, const Eigen::Vector3d& v) noexcept;

/// Angle 4 that goes with angles 5 and 6: axis 5 where the tool has it, seen from axis 4. `frame4`:
/// of axis 4 with its own joint at zero; R: of the canonical tool.
inline Angle angle4(const Wrist& wrist, const Eigen::Matrix3d& frame4, const Eigen::Matrix3d& R,
                    const Angle& angle6) noexcept {
  const Eigen::Vector3d axis5 = wrist.sin_alpha * (angle6.cos * R.col(0) - angle6.sin * R.col(1)) +
                                wrist.cos_alpha * R.col(2);
  return normalized(axis5.dot(frame4.col(0)), axis5.dot(frame4.col(1))) * wrist.from_axis5;
}

/// Angle 6 that goes with angle 5. `v`: axis 4 in the canonical tool. False where it is in line
/// with axis 6: then the angle stays where it is best.
inline bool find_angle6(const Wrist& wrist, const Question& question, const Eigen::Vector3d& v,
                        const Angle& angle5, Angle& angle6) noexcept {
  const double x = wrist.cos_beta * wrist.sin_alpha - wrist.sin_beta * wrist.cos_alpha * angle5.cos;
  const double y = wrist.sin_beta * angle5.sin;
  if (v[0] * v[0] + v[1] * v[1] <= kFree * kFree || x * x + y * y <= kFree * kFree) {
    angle6 = question.stay(5);
    return false;
  }
  angle6 = normalized(x * v[0] + y * v[1], y * v[0] - x * v[1]);
  return true;
}

}  // namespace thing_kin::closed_form
