#include "thing_kin/model/obstacle.hpp"

#include <algorithm>

#include "thing_kin/core/tolerance.hpp"

namespace thing_kin {

namespace {

/// The way from the nearest of a shape's innermost points (a center, an axis, a box's corner or
/// edge), and the directions in which that point does not come along, as a projector.
///
/// All distances here are |way| - radius, with the Hessian (free - g g^T)/|way| where g =
/// way/|way|.
struct Way {
  Eigen::Vector3d way;
  Eigen::Matrix3d free;
};

SignedDistance from_way(const Way& from, double radius) noexcept {
  const double length = from.way.stableNorm();
  if (!(length > 0.0)) {
    // Every way leads off; the first free axis will do.
    Eigen::Index axis = 0;
    from.free.diagonal().maxCoeff(&axis);
    return {-radius, from.free.col(axis).normalized(), Eigen::Matrix3d::Zero()};
  }
  const Eigen::Vector3d g = from.way / length;
  return {length - radius, g, (from.free - g * g.transpose()) / length};
}

Eigen::Vector3d way_from(const Disc& disc, const Eigen::Vector3d& p) noexcept {
  return {p[0] - disc.center[0], p[1] - disc.center[1], 0.0};
}

/// Where on the segment the nearest point is: 0 ... 1.
double place_on(const Capsule& capsule, const Eigen::Vector3d& p) noexcept {
  const Eigen::Vector3d along = capsule.end - capsule.start;
  const double square = along.squaredNorm();
  return square > 0.0 ? std::clamp(along.dot(p - capsule.start) / square, 0.0, 1.0) : 0.0;
}

/// How far beyond the faces: negative inside.
Eigen::Vector3d beyond_faces(const Box& box, const Eigen::Vector3d& local) noexcept {
  return local.cwiseAbs() - box.half_size;
}

Eigen::Vector3d into(const Box& box, const Eigen::Vector3d& p) noexcept {
  return box.pose.rotation.transpose() * (p - box.pose.translation);
}

SignedDistance distance(const Disc& disc, const Eigen::Vector3d& p) noexcept {
  return from_way({way_from(disc, p), Eigen::Vector3d(1, 1, 0).asDiagonal()}, disc.radius);
}

SignedDistance distance(const Sphere& sphere, const Eigen::Vector3d& p) noexcept {
  return from_way({p - sphere.center, Eigen::Matrix3d::Identity()}, sphere.radius);
}

SignedDistance distance(const Capsule& capsule, const Eigen::Vector3d& p) noexcept {
  const Eigen::Vector3d along = capsule.end - capsule.start;
  const double place = place_on(capsule, p);
  Way from{p - (capsule.start + place * along), Eigen::Matrix3d::Identity()};
  if (place > 0.0 && place < 1.0) {  // the nearest point slides along
    const Eigen::Vector3d axis = along.stableNormalized();
    from.free -= axis * axis.transpose();
    // On the axis the way is rounding, of any direction.
    const double size = p.norm() + capsule.start.norm() + along.norm();
    if (from.way.norm() <= 4 * kEpsilon * size) {
      from.way.setZero();
    }
  }
  return from_way(from, capsule.radius);
}

SignedDistance distance(const Box& box, const Eigen::Vector3d& p) noexcept {
  const Eigen::Vector3d local = into(box, p);
  const Eigen::Vector3d beyond = beyond_faces(box, local);
  const Eigen::Vector3d sign = local.unaryExpr([](double x) { return x < 0.0 ? -1.0 : 1.0; });
  const Eigen::Matrix3d& R = box.pose.rotation;
  Eigen::Index face = 0;
  const double nearest = beyond.maxCoeff(&face);
  if (nearest <= 0.0) {
    return {nearest, sign[face] * R.col(face), Eigen::Matrix3d::Zero()};
  }
  const Eigen::Vector3d outside = (beyond.array() > 0.0).cast<double>();
  const Eigen::Vector3d way = beyond.cwiseMax(0.0).cwiseProduct(sign);
  return from_way({R * way, R * outside.asDiagonal() * R.transpose()}, 0.0);
}

SignedDistance distance(const HalfSpace& half, const Eigen::Vector3d& p) noexcept {
  return {half.normal.dot(p) - half.offset, half.normal, Eigen::Matrix3d::Zero()};
}

double value(const Disc& disc, const Eigen::Vector3d& p) noexcept {
  return way_from(disc, p).norm() - disc.radius;
}

double value(const Sphere& sphere, const Eigen::Vector3d& p) noexcept {
  return (p - sphere.center).norm() - sphere.radius;
}

double value(const Capsule& capsule, const Eigen::Vector3d& p) noexcept {
  const Eigen::Vector3d along = capsule.end - capsule.start;
  return (p - (capsule.start + place_on(capsule, p) * along)).norm() - capsule.radius;
}

double value(const Box& box, const Eigen::Vector3d& p) noexcept {
  const Eigen::Vector3d beyond = beyond_faces(box, into(box, p));
  const double nearest = beyond.maxCoeff();
  return nearest <= 0.0 ? nearest : beyond.cwiseMax(0.0).norm();
}

double value(const HalfSpace& half, const Eigen::Vector3d& p) noexcept {
  return half.normal.dot(p) - half.offset;
}

}  // namespace

SignedDistance signed_distance(const Obstacle& obstacle, const Eigen::Vector3d& point) noexcept {
  return std::visit([&](const auto& shape) noexcept { return distance(shape, point); }, obstacle);
}

double signed_distance_value(const Obstacle& obstacle, const Eigen::Vector3d& point) noexcept {
  return std::visit([&](const auto& shape) noexcept { return value(shape, point); }, obstacle);
}

}  // namespace thing_kin
