// Arms whose axes 4, 5 and 6 meet in a point p: after Pieper (1968). With w = R1^T p - p12 and
// v = p23 + R3 p34, the first three joints must make w = R2 v, so that
//
//     |w|^2 = |v|^2  and  h2 . w = h2 . v,
//
// two equations in angles 1 and 3. Where two of the first three axes meet or are parallel, a
// combination of them has one angle alone, else they are a quartic. Then angle 2, and the wrist.

#include <Eigen/Geometry>

#include "closed_form_ik_subproblems.hpp"

namespace thing_kin::closed_form {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Matrix3d about_z(const Angle& angle) {
  Matrix3d R;
  R << angle.cos, -angle.sin, 0, angle.sin, angle.cos, 0, 0, 0, 1;
  return R;
}

Vector3d turned(const Angle& angle, const Vector3d& v) {
  return {angle.cos * v[0] - angle.sin * v[1], angle.sin * v[0] + angle.cos * v[1], v[2]};
}

/// A row without its angles.
double constant(const SphericalRow& row, const Vector3d& p) {
  return row.constant + row.squared * p.squaredNorm() + row.height * p[2];
}

/// u . (x, y) of a row as a factor of (cos, sin) of angle 1.
Vector2d of_first(const SphericalRow& row, const Vector3d& p) {
  return {row.u[0] * p[0] + row.u[1] * p[1], row.u[0] * p[1] - row.u[1] * p[0]};
}

/// Angles 1 and 3, and how they were found.
struct Pair {
  Angle first, third;
  double excess = 0.0;
  ArmSingularity singularity = ArmSingularity::kNone;
};

struct Pairs {
  int count = 0;
  std::array<Pair, 4> pair;

  void add(const Pair& p) { pair[static_cast<std::size_t>(count++)] = p; }
};

ArmSingularity named(ArmSingularity before, double separation, ArmSingularity name) {
  return before == ArmSingularity::kNone && separation <= kSingularAngle ? name : before;
}

Roots roots_of_first(const SphericalRow& row, const Question& question, const Angle& third) {
  const Vector2d a = of_first(row, question.p);
  const double d = row.v[0] * third.cos + row.v[1] * third.sin - constant(row, question.p);
  Roots roots = solve_linear(a[0], a[1], d, question.length * row.u.norm());
  if (roots.free) {
    roots.angle[0] = roots.angle[1] = question.stay(0);
  }
  return roots;
}

Roots roots_of_third(const SphericalRow& row, const Question& question, const Angle& first) {
  const Vector2d a = of_first(row, question.p);
  const double d = constant(row, question.p) + a[0] * first.cos + a[1] * first.sin;
  return solve_linear(row.v[0], row.v[1], d, row.v.norm());
}

Pairs first_then_third(const SphericalArm& arm, const Question& question) {
  Pairs pairs;
  const Roots first = roots_of_first(arm.rows[0], question, {0.0, 0.0});
  for (const Angle& one : first.angle) {
    const Roots third = roots_of_third(arm.rows[1], question, one);
    for (const Angle& three : third.angle) {
      Pair pair{one, three, std::max(first.excess, third.excess), ArmSingularity::kNone};
      pair.singularity = named(pair.singularity, first.separation, ArmSingularity::kShoulder);
      if (first.free) {
        pair.singularity = ArmSingularity::kShoulder;
      }
      pair.singularity = named(pair.singularity, third.separation, ArmSingularity::kElbow);
      pairs.add(pair);
    }
  }
  return pairs;
}

Pairs third_then_first(const SphericalArm& arm, const Question& question) {
  Pairs pairs;
  const Roots third = roots_of_third(arm.rows[0], question, {0.0, 0.0});
  for (const Angle& three : third.angle) {
    const Roots first = roots_of_first(arm.rows[1], question, three);
    for (const Angle& one : first.angle) {
      Pair pair{one, three, std::max(first.excess, third.excess), ArmSingularity::kNone};
      pair.singularity = first.free ? ArmSingularity::kShoulder : ArmSingularity::kNone;
      pair.singularity = named(pair.singularity, first.separation, ArmSingularity::kShoulder);
      pair.singularity = named(pair.singularity, third.separation, ArmSingularity::kElbow);
      pairs.add(pair);
    }
  }
  return pairs;
}

Pairs by_quartic(const SphericalArm& arm, const Question& question) {
  Eigen::Matrix2d V;
  Eigen::Matrix2d U;
  Vector2d e;
  for (int i = 0; i < 2; ++i) {
    const SphericalRow& row = arm.rows[static_cast<std::size_t>(i)];
    V.row(i) = row.v.transpose();
    U.row(i) = of_first(row, question.p).transpose();
    e[i] = constant(row, question.p);
  }
  const double determinant = V(0, 0) * V(1, 1) - V(0, 1) * V(1, 0);
  Eigen::Matrix2d inverse;
  inverse << V(1, 1), -V(0, 1), -V(1, 0), V(0, 0);
  inverse /= determinant;
  const Eigen::Matrix2d N = inverse * U;
  const Vector2d n = inverse * e;
  const QuarticRoots roots = solve_quartic(N, n);
  Pairs pairs;
  for (int i = 0; i < roots.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    Pair pair;
    pair.first = roots.free ? question.stay(0) : roots.angle[at];
    const Vector2d third = N * Vector2d(pair.first.cos, pair.first.sin) + n;
    pair.third = normalized(third[0], third[1]);
    pair.excess = roots.excess[at];
    pair.singularity = named(pair.singularity, roots.separation[at],
                             roots.free ? ArmSingularity::kShoulder : ArmSingularity::kElbow);
    pairs.add(pair);
  }
  return pairs;
}

void add(const SphericalArm& arm, const Question& question, const Pair& pair, Branches& out) {
  const Vector3d w = arm.R12.transpose() * (turned(pair.first.inverse(), question.p) - arm.p12);
  const Vector3d v =
      arm.p23 + arm.R23 * Vector3d(arm.r34 * pair.third.cos, arm.r34 * pair.third.sin, 0.0);
  Branch start;
  start.angle[0] = pair.first;
  start.angle[2] = pair.third;
  start.excess = pair.excess;
  start.singularity = pair.singularity;
  const double off_axis = std::sqrt(v[0] * v[0] + v[1] * v[1]);
  if (off_axis <= kFree * question.length) {  // p on axis 2
    start.angle[1] = question.stay(1);
    start.singularity = ArmSingularity::kShoulder;
  } else {
    start.angle[1] = normalized(w[0] * v[0] + w[1] * v[1], w[1] * v[0] - w[0] * v[1]);
  }
  const Matrix3d frame = about_z(start.angle[0]) * arm.R12 * about_z(start.angle[1]) * arm.R23 *
                         about_z(start.angle[2]) * arm.R34;
  const Vector3d axis4 = question.R.transpose() * frame.col(2);
  const WristBend bend = solve_bend(arm.wrist, axis4);
  for (const Angle& angle : {bend.angle, bend.angle.inverse()}) {
    Branch& branch = out.branch[static_cast<std::size_t>(out.count++)];
    branch = start;
    branch.angle[4] = angle;
    branch.excess = std::max(start.excess, bend.excess);
    branch.singularity = named(start.singularity, std::abs(angle.sin), ArmSingularity::kWrist);
    find_angle6(arm.wrist, question, axis4, angle, branch.angle[5]);
    branch.angle[3] = angle4(arm.wrist, frame, question.R, branch.angle[5]);
  }
}

}  // namespace

void solve_arm(const SphericalArm& arm, const Question& question, Branches& out) noexcept {
  const Pairs pairs = arm.order == SphericalArm::Order::kFirst   ? first_then_third(arm, question)
                      : arm.order == SphericalArm::Order::kThird ? third_then_first(arm, question)
                                                                 : by_quartic(arm, question);
  for (int i = 0; i < pairs.count; ++i) {
    add(arm, question, pairs.pair[static_cast<std::size_t>(i)], out);
  }
}

}  // namespace thing_kin::closed_form
