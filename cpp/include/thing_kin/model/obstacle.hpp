#pragma once

#include <string>
#include <variant>

#include "thing_kin/lie/se3.hpp"

namespace thing_kin {

/// Keeps the base's reference point away, whatever its height: an upright cylinder, [M17] (4.29).
struct Disc {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< m
  double radius = 0.0;                               ///< m

  bool operator==(const Disc&) const = default;
};

struct Sphere {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< m
  double radius = 0.0;                               ///< m

  bool operator==(const Sphere&) const = default;
};

/// All points within `radius` of the segment from `start` to `end`.
struct Capsule {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d end = Eigen::Vector3d::Zero();    ///< m
  double radius = 0.0;                              ///< m

  bool operator==(const Capsule&) const = default;
};

struct Box {
  SE3 pose;                                             ///< of its middle
  Eigen::Vector3d half_size = Eigen::Vector3d::Zero();  ///< m

  bool operator==(const Box&) const = default;
};

/// All points p with normal . p <= offset; the normal is of unit length and points outside.
struct HalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0.0;  ///< m

  bool operator==(const HalfSpace&) const = default;
};

using Obstacle = std::variant<Disc, Sphere, Capsule, Box, HalfSpace>;

/// Throws InvalidArgument unless radii and sizes are positive, the normal is of unit length, the
/// pose is rigid and all is finite. The argument named is `prefix` and the member.
void check(const Obstacle& obstacle, const std::string& prefix = "");

/// Distance from a point to a surface and its derivatives by the point; negative inside.
struct SignedDistance {
  double value;
  Eigen::Vector3d gradient;  ///< of unit length; where it does not exist, one of its limits
  Eigen::Matrix3d hessian;   ///< zero where the gradient does not exist
};

/// Of a box the distance outside is Euclidean; inside it is to the nearest face, and its gradient
/// jumps where two faces are equally near. Other gradients jump at a center or an axis only.
SignedDistance signed_distance(const Obstacle& obstacle, const Eigen::Vector3d& point) noexcept;

/// Its value alone.
double signed_distance_value(const Obstacle& obstacle, const Eigen::Vector3d& point) noexcept;

}  // namespace thing_kin
