#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "closed_form_ik_geometry.hpp"

namespace thing_kin::closed_form {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Where axes 4, 5 and 6 meet.
Vector3d wrist_center(const Axes& axes, double tolerance, Misfit& misfit) {
  const CommonNormal first = common_normal(axes, 3, 4, tolerance);
  const CommonNormal second = common_normal(axes, 4, 5, tolerance);
  const Vector3d center = 0.5 * (first.on_second + second.on_first);
  const bool parallel = first.sine <= tolerance || second.sine <= tolerance;
  misfit.distance =
      parallel
          ? std::numeric_limits<double>::infinity()
          : std::max({first.distance, second.distance, (first.on_second - second.on_first).norm()});
  return center;
}

/// The first three joints.
struct Shoulder {
  CommonNormal normal12;
  Matrix3d frame1, frame2, frame3;
  Vector3d p3;  ///< the foot of the wrist's center on axis 3
  bool parallel12, parallel23, meet12, meet23;
};

/// The axis itself, or the other's direction if they are parallel but for rounding.
Vector3d straightened(const Vector3d& axis, const Vector3d& other, bool parallel) {
  return parallel ? Vector3d(std::copysign(1.0, axis.dot(other)) * other) : axis;
}

Shoulder shoulder_of(const Axes& axes, const Vector3d& center, double tolerance, double length) {
  Shoulder s;
  s.normal12 = common_normal(axes, 0, 1, tolerance);
  const CommonNormal normal23 = common_normal(axes, 1, 2, tolerance);
  s.parallel12 = s.normal12.sine <= tolerance;
  s.parallel23 = normal23.sine <= tolerance;
  s.meet12 = !s.parallel12 && s.normal12.distance <= tolerance * length;
  s.meet23 = !s.parallel23 && normal23.distance <= tolerance * length;
  const Vector3d h2 = straightened(axes.direction[1], axes.direction[0], s.parallel12);
  const Vector3d h3 = straightened(axes.direction[2], h2, s.parallel23);
  s.p3 = axes.point[2] + (center - axes.point[2]).dot(h3) * h3;
  s.frame1 = frame_along(axes.direction[0],
                         s.parallel12 ? s.normal12.on_second - s.normal12.on_first : h2);
  s.frame2 = frame_along(h2, s.frame1.col(0));
  s.frame3 = frame_along(h3, center - s.p3);
  return s;
}

/// |w|^2 = |v|^2, halved, and h2 . w = h2 . v, in the terms of SphericalRow.
std::array<SphericalRow, 2> rows_of(const Shoulder& s, const SphericalArm& arm) {
  const Vector3d in_frame3 = s.frame3.transpose() * (s.p3 - s.normal12.on_second);
  const Vector3d h2_in_frame1 = arm.R12.col(2);
  const Vector3d h2_in_frame3 = arm.R23.row(2).transpose();
  SphericalRow squared;
  squared.constant = 0.5 * (arm.p12.squaredNorm() - arm.p23.squaredNorm() - arm.r34 * arm.r34);
  squared.squared = 0.5;
  squared.height = -arm.p12[2];
  squared.u = -arm.p12.head<2>();
  squared.v = arm.r34 * in_frame3.head<2>();
  SphericalRow along;
  along.constant = -h2_in_frame1.dot(arm.p12) - arm.p23[2];
  along.height = h2_in_frame1[2];
  along.u = h2_in_frame1.head<2>();
  along.v = arm.r34 * h2_in_frame3.head<2>();
  return {squared, along};
}

SphericalRow minus(const SphericalRow& a, double factor, const SphericalRow& b) {
  return {a.constant - factor * b.constant, a.squared - factor * b.squared,
          a.height - factor * b.height, a.u - factor * b.u, a.v - factor * b.v};
}

/// Combines the rows so that row 0 has one angle alone, where the geometry allows it.
void set_rows(const Shoulder& s, SphericalArm& arm) {
  auto [squared, along] = rows_of(s, arm);
  if (s.parallel23) {
    along.v.setZero();
    arm.order = SphericalArm::Order::kFirst;
    arm.rows = {along, squared};
  } else if (s.parallel12) {
    along.u.setZero();
    arm.order = SphericalArm::Order::kThird;
    arm.rows = {along, squared};
  } else if (s.meet12) {
    squared.u.setZero();
    arm.order = SphericalArm::Order::kThird;
    arm.rows = {squared, along};
  } else if (s.meet23) {
    squared = minus(squared, squared.v.dot(along.v) / along.v.squaredNorm(), along);
    squared.v.setZero();
    arm.order = SphericalArm::Order::kFirst;
    arm.rows = {squared, along};
  } else {
    arm.order = SphericalArm::Order::kQuartic;
    arm.rows = {squared, along};
  }
}

bool determines(const SphericalArm& arm, double small) {
  const auto& [zero, one] = arm.rows;
  switch (arm.order) {
    case SphericalArm::Order::kFirst:
      return zero.u.norm() > small && one.v.norm() > small;
    case SphericalArm::Order::kThird:
      return zero.v.norm() > small && one.u.norm() > small;
    case SphericalArm::Order::kQuartic:
      break;
  }
  return std::abs(zero.v[0] * one.v[1] - zero.v[1] * one.v[0]) > 0.0;
}

}  // namespace

std::optional<Canonical<SphericalArm>> as_spherical(const Axes& axes, double tolerance,
                                                    Misfit& misfit) {
  const double length = length_of(axes);
  const Vector3d center = wrist_center(axes, tolerance, misfit);
  if (misfit.distance > tolerance * length) {
    return std::nullopt;
  }
  const Shoulder s = shoulder_of(axes, center, tolerance, length);
  const Matrix3d frame4 = frame_along(axes.direction[3], s.frame3.col(0));
  const Matrix3d hand = frame_along(axes.direction[5], axes.direction[4]);
  Canonical<SphericalArm> made;
  SphericalArm& arm = made.constants;
  made.root = {s.frame1, s.normal12.on_first};
  made.hand = axes.tool.inverse() * SE3{hand, center};
  arm.R12 = s.frame1.transpose() * s.frame2;
  arm.R23 = s.frame2.transpose() * s.frame3;
  arm.R34 = s.frame3.transpose() * frame4;
  arm.p12 = s.frame1.transpose() * (s.normal12.on_second - s.normal12.on_first);
  arm.p23 = s.frame2.transpose() * (s.p3 - s.normal12.on_second);
  arm.r34 = (center - s.p3).norm();
  set_rows(s, arm);
  const bool turns =
      make_wrist(frame4, axes.direction[4], hand, tolerance, arm.wrist, made.angle[4]);
  misfit.degenerate = !turns || arm.r34 <= tolerance * length ||
                      !determines(arm, tolerance * std::min(1.0, length * length));
  if (misfit.degenerate) {
    return std::nullopt;
  }
  return made;
}

}  // namespace thing_kin::closed_form
