#include "thing_kin/lie/se2.hpp"

#include <cmath>
#include <numbers>

#include "thing_kin/lie/series.hpp"

namespace thing_kin {

namespace {

// [[a, -b], [b, a]] (x, y)
Eigen::Vector2d turned(double a, double b, const Eigen::Vector2d& v) {
  return {a * v.x() - b * v.y(), b * v.x() + a * v.y()};
}

}  // namespace

double wrap_angle(double angle) {
  if (angle > -std::numbers::pi && angle <= std::numbers::pi) {
    return angle;  // as below, without a division
  }
  const double wrapped = std::remainder(angle, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? wrapped + 2.0 * std::numbers::pi : wrapped;
}

Pose2 compose(const Pose2& a_b, const Pose2& b_c) {
  Pose2 a_c;
  a_c << a_b.head<2>() + turned(std::cos(a_b.z()), std::sin(a_b.z()), b_c.head<2>()),
      wrap_angle(a_b.z() + b_c.z());
  return a_c;
}

Pose2 inverse(const Pose2& pose) {
  Pose2 inverted;
  inverted << -turned(std::cos(pose.z()), -std::sin(pose.z()), pose.head<2>()),
      wrap_angle(-pose.z());
  return inverted;
}

Pose2 between(const Pose2& a, const Pose2& b) {
  Pose2 seen;
  seen << turned(std::cos(a.z()), -std::sin(a.z()), b.head<2>() - a.head<2>()),
      wrap_angle(b.z() - a.z());
  return seen;
}

Pose2 pose_difference(const Pose2& a, const Pose2& b) {
  return {a.x() - b.x(), a.y() - b.y(), wrap_angle(a.z() - b.z())};
}

Pose2 se2_exp(const Twist2& xi) {
  const double t = xi.z() * xi.z();
  Pose2 pose;
  pose << turned(phi<1>(t), xi.z() * phi<2>(t), xi.head<2>()), wrap_angle(xi.z());
  return pose;
}

Twist2 se2_log(const Pose2& pose) {
  const double theta = wrap_angle(pose.z());
  const double t = theta * theta;
  const double a = phi<1>(t);
  const double b = theta * phi<2>(t);
  Twist2 xi;
  xi << turned(a, -b, pose.head<2>()) / (a * a + b * b), theta;
  return xi;
}

Eigen::Matrix3d se2_adjoint(const Pose2& pose) {
  const double c = std::cos(pose.z());
  const double s = std::sin(pose.z());
  Eigen::Matrix3d Ad;
  Ad << c, -s, pose.y(), s, c, -pose.x(), 0.0, 0.0, 1.0;
  return Ad;
}

Eigen::Matrix3d se2_left_jacobian(const Twist2& xi) {
  const double t = xi.z() * xi.z();
  const double a = phi<1>(t);
  const double b = xi.z() * phi<2>(t);
  const double p2 = phi<2>(t);
  const double p3 = xi.z() * phi<3>(t);
  Eigen::Matrix3d left;
  left << a, -b, p3 * xi.x() + p2 * xi.y(), b, a, p3 * xi.y() - p2 * xi.x(), 0.0, 0.0, 1.0;
  return left;
}

Eigen::Matrix3d se2_right_jacobian(const Twist2& xi) { return se2_left_jacobian(-xi); }

Eigen::Matrix3d se2_left_jacobian_inverse(const Twist2& xi) {
  const Eigen::Matrix3d left = se2_left_jacobian(xi);
  const double a = left(0, 0);
  const double b = left(1, 0);
  const double size = a * a + b * b;
  Eigen::Matrix3d inverted = Eigen::Matrix3d::Identity();
  inverted.topLeftCorner<2, 2>() << a / size, b / size, -b / size, a / size;
  inverted.topRightCorner<2, 1>() = -turned(a, -b, left.topRightCorner<2, 1>()) / size;
  return inverted;
}

Eigen::Matrix3d se2_right_jacobian_inverse(const Twist2& xi) {
  return se2_left_jacobian_inverse(-xi);
}

}  // namespace thing_kin
