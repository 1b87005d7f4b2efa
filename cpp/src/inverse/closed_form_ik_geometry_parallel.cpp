#include <cmath>

#include <Eigen/Geometry>

#include "closed_form_ik_geometry.hpp"

namespace thing_kin::closed_form {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// The mean direction of axes 2, 3 and 4, as joint 2 turns, and the other two's senses.
struct Direction {
  Vector3d h;
  double sign3 = 1.0, sign4 = 1.0;
};

Direction direction_of(const Axes& axes, Misfit& misfit) {
  const Vector3d& two = axes.direction[1];
  const Vector3d& three = axes.direction[2];
  const Vector3d& four = axes.direction[3];
  misfit.angle = std::max(two.cross(three).norm(), two.cross(four).norm());
  Direction result;
  result.sign3 = std::copysign(1.0, two.dot(three));
  result.sign4 = std::copysign(1.0, two.dot(four));
  result.h = (two + result.sign3 * three + result.sign4 * four).normalized();
  return result;
}

/// Axes 5 and 6: the points that joint 5's offset goes between, and the canonical tool.
struct Hand {
  Vector3d p5, p6;
  Matrix3d frame;
  double offset = 0.0;
  bool parallel = false;
};

Hand hand_of(const Axes& axes, double tolerance, double length) {
  const CommonNormal normal = common_normal(axes, 4, 5, tolerance);
  Hand hand{normal.on_first, normal.on_second, {}, 0.0, normal.sine <= tolerance};
  const Vector3d between = normal.on_second - normal.on_first;
  if (hand.parallel) {
    hand.frame = frame_along(axes.direction[5], between);
    hand.offset = normal.distance;
    return hand;
  }
  hand.frame = frame_along(axes.direction[5], axes.direction[4]);
  if (normal.distance > tolerance * length) {
    hand.offset = between.dot(hand.frame.col(1));
  } else {
    hand.p5 = hand.p6 = 0.5 * (normal.on_first + normal.on_second);
  }
  return hand;
}

/// What hangs on joint 4, in the plane, as a function of joint 5's angle.
void set_forearm(const Axes& axes, const Hand& hand, const Matrix3d& frame4, double offset5,
                 ParallelArm& arm) {
  const auto plane = [&](const Vector3d& v) {
    return Vector2d(v.dot(frame4.col(0)), v.dot(frame4.col(1)));
  };
  const Vector3d p56 = hand.p6 - hand.p5;
  const Vector3d across = axes.direction[4].cross(p56);
  arm.forearm = plane(hand.p5 - axes.point[3]);
  arm.forearm_cos = plane(std::cos(offset5) * p56 - std::sin(offset5) * across);
  arm.forearm_sin = plane(std::sin(offset5) * p56 + std::cos(offset5) * across);
}

/// The links between the parallel axes, and the angles that count from them.
void set_links(const Axes& axes, const Direction& direction, const Matrix3d& frame4,
               Canonical<ParallelArm>& made) {
  const auto plane = [&](const Vector3d& v) {
    return Vector2d(v.dot(frame4.col(0)), v.dot(frame4.col(1)));
  };
  const Vector2d upper = plane(axes.point[2] - axes.point[1]);
  const Vector2d lower = plane(axes.point[3] - axes.point[2]);
  made.constants.start = plane(axes.point[1] - axes.point[0]);
  made.constants.upper = upper.norm();
  made.constants.lower = lower.norm();
  const double of_upper = std::atan2(upper[1], upper[0]);
  const double of_lower = std::atan2(lower[1], lower[0]);
  made.angle[1] = {1.0, of_upper};
  made.angle[2] = {direction.sign3, of_lower - of_upper};
  made.angle[3] = {direction.sign4, -of_lower};
}

}  // namespace

std::optional<Canonical<ParallelArm>> as_parallel(const Axes& axes, double tolerance,
                                                  Misfit& misfit) {
  const double length = length_of(axes);
  const Direction direction = direction_of(axes, misfit);
  if (misfit.angle > tolerance) {
    return std::nullopt;
  }
  Canonical<ParallelArm> made;
  ParallelArm& arm = made.constants;
  made.root = {frame_along(axes.direction[0], direction.h), axes.point[0]};
  arm.hx = direction.h.dot(made.root.rotation.col(0));
  arm.hz = direction.h.dot(made.root.rotation.col(2));
  if (std::abs(arm.hz) <= 1e-14) {
    arm.hx = 1.0;
    arm.hz = 0.0;
  }
  Matrix3d frame4;
  frame4 << -arm.hz, 0.0, arm.hx, 0.0, -1.0, 0.0, arm.hx, 0.0, arm.hz;
  frame4 = (made.root.rotation * frame4).eval();

  const Hand hand = hand_of(axes, tolerance, length);
  arm.parallel56 = hand.parallel;
  arm.offset56 = hand.offset;
  arm.along = direction.h.dot(hand.p5 - axes.point[0]);
  made.hand = axes.tool.inverse() * SE3{hand.frame, hand.p6};
  set_links(axes, direction, frame4, made);
  const bool turns =
      make_wrist(frame4, axes.direction[4], hand.frame, tolerance, arm.wrist, made.angle[4]);
  set_forearm(axes, hand, frame4, made.angle[4].offset, arm);
  misfit.degenerate = !turns || arm.hx <= tolerance || arm.upper <= tolerance * length ||
                      arm.lower <= tolerance * length ||
                      (hand.parallel && hand.offset <= tolerance * length);
  if (misfit.degenerate) {
    return std::nullopt;
  }
  return made;
}

}  // namespace thing_kin::closed_form
