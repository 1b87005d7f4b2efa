#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "thing_kin/odometry/local_map.hpp"
#include "thing_kin/odometry/scan.hpp"

namespace thing_kin {

/// Points look for the map within a distance that shrinks to this, m.
inline constexpr double kLastDistance = 0.15;
/// Of the robust loss, m: a point so far off counts a quarter.
inline constexpr double kLossScale = 0.1;
/// A place pulls along both axes, less than a line across its own, and from twice as far.
inline constexpr double kPlaceWeight = 0.5;
inline constexpr double kPlaceScale = 2.0 * kLossScale;

/// So many of it, and memory for twice as many: none is needed anew for each one more.
template <typename T>
void assign_with_room(std::vector<T>& values, std::size_t count, const T& value) {
  if (values.capacity() < count) {
    values.reserve(2 * count);
  }
  values.assign(count, value);
}

/// What the points say at a pose: A step = -g.
struct PointToLine {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  double weight = 0.0;     ///< sum of the weights
  double arm2 = 0.0;       ///< sum of weight times squared distance
  double agreement = 0.0;  ///< of each point 0 to 1, summed
  double squares = 0.0;    ///< of the inliers' residuals
  double weighted_squares = 0.0;
  int inliers = 0;
};

struct Pairing {
  const Surfel* surfel;
  Eigen::Vector2d arm;    ///< from the robot to the point, map axes
  Eigen::Vector2d error;  ///< from the map to the point
};

/// What a point was paired with, and where: kept while it can't be paired otherwise.
struct Kept {
  const Surfel* surfel = nullptr;
  double slack = -1.0;  ///< m; negative: to be searched
  Eigen::Vector2d p = Eigen::Vector2d::Zero();
  double theta = 0.0;
  double distance = 0.0;
};

/// A point's surfel within `distance`.
const Surfel* paired(const LocalMap& map, const Eigen::Vector2d& p, const Eigen::Vector2d& normal,
                     double theta, double distance, Kept& kept);

/// Calls visit(pairing) for each point, or one in `stride`, that has a surfel at that pose.
template <typename Visit>
void visit_pairs(const LocalMap& map, const PlanarScan& scan, const Pose2& pose, double distance,
                 std::size_t stride, std::vector<Kept>& kept, Visit&& visit) {
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(pose.z()).toRotationMatrix();
  for (std::size_t k = 0; k < scan.size(); k += stride) {
    const ScanPoint& point = scan[k];
    const Eigen::Vector2d arm = R * point.p;
    const Eigen::Vector2d p = arm + pose.head<2>();
    const Surfel* surfel = paired(map, p, R * point.normal, pose.z(), distance, kept[k]);
    if (surfel != nullptr &&
        (surfel->is_surface() || point.surroundings != Surroundings::kSparse)) {
      visit(Pairing{.surfel = surfel, .arm = arm, .error = p - surfel->line_p});
    }
  }
}

/// Calls row(J, e, w) for each equation of a pair; returns the agreement.
template <typename Row>
double equations(const Pairing& pair, Row&& row) {
  const Eigen::Vector2d& n = pair.surfel->line_normal;
  const Eigen::Vector2d& arm = pair.arm;
  if (pair.surfel->is_surface()) {
    const double e = n.dot(pair.error);
    const double share = 1.0 / (1.0 + e * e / (kLossScale * kLossScale));
    row(Eigen::Vector3d(n.x(), n.y(), n.y() * arm.x() - n.x() * arm.y()), e, share * share);
    return share;
  }
  const double share = 1.0 / (1.0 + pair.error.squaredNorm() / (kPlaceScale * kPlaceScale));
  const double w = kPlaceWeight * share * share;
  row(Eigen::Vector3d(1.0, 0.0, -arm.y()), pair.error.x(), w);
  row(Eigen::Vector3d(0.0, 1.0, arm.x()), pair.error.y(), w);
  return share;
}

/// The equations of all points at a pose, point to line (Censi 2008) under a robust loss (Geman and
/// McClure).
PointToLine point_to_line(const LocalMap& map, const PlanarScan& scan, const Pose2& pose,
                          double distance, std::size_t stride, std::vector<Kept>& kept);

/// Directions in which theta counts by the points' distance; ascending in what is told of them.
struct Directions {
  Eigen::Vector3d scale;   ///< what a unit is: 1 m, 1 m, 1/arm rad
  Eigen::Vector3d told;    ///< sums of weights
  Eigen::Matrix3d vector;  ///< columns
  int untold = 0;          ///< how many come first

  Directions(const PointToLine& normal, double share);

  /// Newton's, along what is told.
  Eigen::Vector3d step(const Eigen::Vector3d& g) const;

  /// A small motion without what is not told.
  Eigen::Vector3d along_told(const Eigen::Vector3d& motion) const;
};

}  // namespace thing_kin
