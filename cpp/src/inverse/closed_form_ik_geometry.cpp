#include "closed_form_ik_geometry.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace thing_kin::closed_form {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double length_of(const Axes& axes) {
  double length = (axes.tool.translation - axes.point[5]).norm();
  for (std::size_t i = 0; i < 5; ++i) {
    length += (axes.point[i + 1] - axes.point[i]).norm();
  }
  return length;
}

Axes reversed(const Axes& axes) {
  Axes back;
  back.tool = axes.tool.inverse();
  for (std::size_t i = 0; i < 6; ++i) {
    back.direction[i] = -(back.tool.rotation * axes.direction[5 - i]);
    back.point[i] = back.tool * axes.point[5 - i];
  }
  return back;
}

CommonNormal common_normal(const Axes& axes, std::size_t first, std::size_t second,
                           double tolerance) {
  const Vector3d& a = axes.direction[first];
  const Vector3d& b = axes.direction[second];
  const Vector3d between = axes.point[second] - axes.point[first];
  const Vector3d normal = a.cross(b);
  CommonNormal result;
  result.sine = normal.norm();
  if (result.sine <= tolerance) {
    result.on_first = axes.point[first];
    result.on_second = axes.point[second] - between.dot(b) * b;
  } else {
    const double squared = normal.squaredNorm();
    result.on_first = axes.point[first] + between.cross(b).dot(normal) / squared * a;
    result.on_second = axes.point[second] + between.cross(a).dot(normal) / squared * b;
  }
  result.distance = (result.on_second - result.on_first).norm();
  return result;
}

Matrix3d frame_along(const Vector3d& z, const Vector3d& x) {
  Vector3d along = x - x.dot(z) * z;
  if (along.squaredNorm() < 1e-24) {
    Eigen::Index least = 0;
    z.cwiseAbs().minCoeff(&least);
    along = Vector3d::Unit(least) - z[least] * z;
  }
  Matrix3d frame;
  frame.col(2) = z;
  frame.col(0) = along.normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

bool make_wrist(const Matrix3d& frame4, const Vector3d& axis5, const Matrix3d& hand,
                double tolerance, Wrist& wrist, JointAngle& angle5) {
  constexpr double kExact = 1e-14;  // rounding of a product of a few rotations
  const Vector3d axis4 = frame4.col(2);
  const Vector3d axis6 = hand.col(2);
  wrist.cos_alpha = axis5.dot(axis6);
  wrist.sin_alpha = axis5.dot(hand.col(0));
  wrist.cos_beta = axis4.dot(axis5);
  wrist.sin_beta = axis4.cross(axis5).norm();
  if (wrist.sin_beta <= tolerance) {
    return false;
  }
  wrist.right_angles = std::abs(wrist.cos_alpha) <= kExact && std::abs(wrist.cos_beta) <= kExact;
  if (wrist.right_angles) {
    wrist.cos_alpha = wrist.cos_beta = 0.0;
    wrist.sin_alpha = wrist.sin_beta = 1.0;
  }
  wrist.alpha = std::atan2(wrist.sin_alpha, wrist.cos_alpha);
  wrist.beta = std::atan2(wrist.sin_beta, wrist.cos_beta);
  const Vector3d in_hand = hand.transpose() * axis4;
  angle5.offset =
      std::atan2(in_hand[1], wrist.sin_alpha * in_hand[2] - wrist.cos_alpha * in_hand[0]);
  const double x = axis5.dot(frame4.col(0));
  const double y = axis5.dot(frame4.col(1));
  const double size = std::hypot(x, y);
  wrist.from_axis5 = {x / size, -y / size};
  return true;
}

}  // namespace thing_kin::closed_form
