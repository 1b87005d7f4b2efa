// Arms with axes 2, 3 and 4 parallel. With h their direction, u = R1 h, k axis 6 of the target and
// p a point on it,
//
//     u . k = axis 4 in the canonical tool, along axis 6          -> angle 5
//     u . p = along + what axis 6 stands off axis 5, along h      -> angle 1
//
// after Elias and Wen (2022), "three parallel axes"; where axes 5 and 6 meet, as those of Universal
// Robots do, or are parallel, one equation has angle 1 alone. Then angle 6, the sum of angles 2, 3
// and 4, and the two links in the plane.

#include <algorithm>

#include "closed_form_ik_subproblems.hpp"

namespace thing_kin::closed_form {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Angle negative(const Angle& angle) { return angle.inverse(); }

void mark(Branch& branch, ArmSingularity singularity) {
  if (branch.singularity == ArmSingularity::kNone) {
    branch.singularity = singularity;
  }
}

/// Frame 4 with angles 2, 3 and 4 at zero: its z is u.
Matrix3d frame4(const ParallelArm& arm, const Angle& first) {
  Matrix3d frame;
  frame << -arm.hz * first.cos, first.sin, arm.hx * first.cos,  //
      -arm.hz * first.sin, -first.cos, arm.hx * first.sin,      //
      arm.hx, 0.0, arm.hz;
  return frame;
}

/// Angles 2, 3 and 4 from their sum and where joint 4 must be.
void add_elbow(const ParallelArm& arm, const Question& question, const Vector2d& reach,
               const Angle& sum, const Branch& branch, Branches& out) {
  const double r2 = reach.squaredNorm();
  const double r = std::sqrt(r2);
  const Knee knee = solve_knee(arm.upper, arm.lower, r);
  for (const Angle& elbow : {knee.angle, negative(knee.angle)}) {
    Branch& full = out.branch[static_cast<std::size_t>(out.count++)];
    full = branch;
    full.excess = std::max(branch.excess, knee.excess);
    if (knee.angle.sin <= kSingularAngle) {
      mark(full, ArmSingularity::kElbow);
    }
    const Vector2d link(arm.upper + arm.lower * elbow.cos, arm.lower * elbow.sin);
    const bool folded = r <= kFree * question.length;
    full.angle[1] = folded ? question.stay(1)
                           : normalized(reach[0] * link[0] + reach[1] * link[1],
                                        reach[1] * link[0] - reach[0] * link[1]);
    full.angle[2] = elbow;
    full.angle[3] = sum * (full.angle[1] * elbow).inverse();
  }
}

Vector2d turned(const Angle& angle, const Vector2d& v) {
  return {angle.cos * v[0] - angle.sin * v[1], angle.sin * v[0] + angle.cos * v[1]};
}

/// Axes 4 and 6 in line: the sum may be any, and angle 6 goes with it; but only where joint 4 is
/// within the elbow's reach. If it is not, the nearest sum at which it is, with the elbow stretched
/// or folded.
void move_into_reach(const ParallelArm& arm, const Question& question, const Vector2d& wrist,
                     const Vector2d& hand, double sense, Angle& sum, Angle& angle6) {
  const double r = (wrist - turned(sum, hand)).norm();
  const double stretched = arm.upper + arm.lower;
  const double bound = std::clamp(r, std::abs(arm.upper - arm.lower), stretched);
  if (bound == r) {
    return;
  }
  // |wrist - e^(i sum) hand| = bound
  const Vector2d a(2.0 * wrist.dot(hand), 2.0 * (wrist[1] * hand[0] - wrist[0] * hand[1]));
  const Roots roots =
      solve_linear(a[0], a[1], wrist.squaredNorm() + hand.squaredNorm() - bound * bound,
                   question.length * question.length);
  if (roots.free || roots.excess > 0.0) {
    return;
  }
  const auto turn = [&](const Angle& root) { return root * sum.inverse(); };
  const bool second = turn(roots.angle[1]).cos > turn(roots.angle[0]).cos;
  const Angle by = turn(roots.angle[second ? 1 : 0]);
  sum = sum * by;
  angle6 = angle6 * (sense > 0.0 ? by.inverse() : by);
}

/// The rest from angles 1 and 5.
void add(const ParallelArm& arm, const Question& question, const Matrix3d& frame, const Vector3d& v,
         Branch& branch, Branches& out) {
  if (std::abs(branch.angle[4].sin) <= kSingularAngle && !arm.parallel56) {
    mark(branch, ArmSingularity::kWrist);
  }
  const bool determined = find_angle6(arm.wrist, question, v, branch.angle[4], branch.angle[5]);
  Angle sum = angle4(arm.wrist, frame, question.R, branch.angle[5]);
  Vector2d hand = arm.forearm;
  if (arm.offset56 != 0.0) {
    hand += branch.angle[4].cos * arm.forearm_cos + branch.angle[4].sin * arm.forearm_sin;
  }
  const Vector2d wrist =
      Vector2d(frame.col(0).dot(question.p), frame.col(1).dot(question.p)) - arm.start;
  if (!determined) {
    move_into_reach(arm, question, wrist, hand, v[2], sum, branch.angle[5]);
  }
  add_elbow(arm, question, wrist - turned(sum, hand), sum, branch, out);
}

/// Axis 4 seen from the canonical tool.
Vector3d seen(const Question& question, const Matrix3d& frame) {
  return question.R.transpose() * frame.col(2);
}

Branch shoulder(const Angle& first, double excess, double separation) {
  Branch branch;
  branch.angle[0] = first;
  branch.excess = excess;
  if (separation <= kSingularAngle) {
    branch.singularity = ArmSingularity::kShoulder;
  }
  return branch;
}

void with_both_bends(const ParallelArm& arm, const Question& question, const Branch& start,
                     Branches& out) {
  const Matrix3d frame = frame4(arm, start.angle[0]);
  const Vector3d v = seen(question, frame);
  const WristBend bend = solve_bend(arm.wrist, v);
  for (const Angle& angle : {bend.angle, negative(bend.angle)}) {
    Branch branch = start;
    branch.angle[4] = angle;
    branch.excess = std::max(start.excess, bend.excess);
    add(arm, question, frame, v, branch, out);
  }
}

/// Axes 5 and 6 parallel: the offset between them, along x, gives angle 5.
void with_parallel_bends(const ParallelArm& arm, const Question& question, const Branch& start,
                         Branches& out) {
  const Matrix3d frame = frame4(arm, start.angle[0]);
  const Vector3d v = seen(question, frame);
  const double rest = frame.col(2).dot(question.p) - arm.along;
  const Roots roots = solve_linear(-arm.wrist.cos_alpha * arm.wrist.sin_beta * arm.offset56, 0.0,
                                   rest, question.length);
  for (const Angle& angle : roots.angle) {
    Branch branch = start;
    branch.angle[4] = angle;
    branch.excess = std::max(start.excess, roots.excess);
    if (roots.separation <= kSingularAngle) {
      mark(branch, ArmSingularity::kWrist);
    }
    add(arm, question, frame, v, branch, out);
  }
}

/// Axes 5 and 6 askew: cosine and sine of angle 5 are linear in those of angle 1.
void with_quartic(const ParallelArm& arm, const Question& question, Branches& out) {
  const Wrist& wrist = arm.wrist;
  const Vector3d k = question.R.col(2);
  const Vector3d& p = question.p;
  Eigen::Matrix2d N;
  N.row(0) = arm.hx / (wrist.sin_beta * wrist.sin_alpha) * k.head<2>().transpose();
  N.row(1) = arm.hx / (wrist.sin_beta * arm.offset56) * p.head<2>().transpose();
  const Vector2d n(
      (arm.hz * k[2] - wrist.cos_alpha * wrist.cos_beta) / (wrist.sin_beta * wrist.sin_alpha),
      (arm.hz * p[2] - arm.along) / (wrist.sin_beta * arm.offset56));
  const QuarticRoots roots = solve_quartic(N, n);
  for (int i = 0; i < roots.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Angle first = roots.free ? question.stay(0) : roots.angle[at];
    Branch branch = shoulder(first, roots.excess[at], roots.separation[at]);
    const Vector2d bend = N * Vector2d(first.cos, first.sin) + n;
    branch.angle[4] = normalized(bend[0], bend[1]);
    const Matrix3d frame = frame4(arm, first);
    add(arm, question, frame, seen(question, frame), branch, out);
  }
}

}  // namespace

void solve_arm(const ParallelArm& arm, const Question& question, Branches& out) noexcept {
  if (arm.offset56 != 0.0 && !arm.parallel56) {
    with_quartic(arm, question, out);
    return;
  }
  const Vector3d k = question.R.col(2);
  const Vector3d& row = arm.parallel56 ? k : question.p;
  const double constant = arm.parallel56 ? arm.wrist.cos_beta * arm.wrist.cos_alpha : arm.along;
  const double scale = arm.parallel56 ? 1.0 : question.length;
  const Roots roots =
      solve_linear(arm.hx * row[0], arm.hx * row[1], constant - arm.hz * row[2], scale);
  for (const Angle& angle : roots.angle) {
    const Branch branch =
        shoulder(roots.free ? question.stay(0) : angle, roots.excess, roots.separation);
    if (arm.parallel56) {
      with_parallel_bends(arm, question, branch, out);
    } else {
      with_both_bends(arm, question, branch, out);
    }
    if (roots.free) {
      break;
    }
  }
}

}  // namespace thing_kin::closed_form
