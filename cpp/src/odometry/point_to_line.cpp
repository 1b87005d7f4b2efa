#include "point_to_line.hpp"

#include <Eigen/Eigenvalues>

namespace thing_kin {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// A point that has turned by more, in rad, may face another surface.
constexpr double kKeptTurn = 0.01;

}  // namespace

const Surfel* paired(const LocalMap& map, const Vector2d& p, const Vector2d& normal, double theta,
                     double distance, Kept& kept) {
  const double room = kept.surfel != nullptr ? kept.slack : kept.distance - distance;
  if (kept.slack < 0.0 || std::abs(theta - kept.theta) > kKeptTurn || room < 0.0 ||
      (p - kept.p).squaredNorm() > room * room) {
    const LocalMap::Nearest found = map.nearest_of_two(p, normal, distance);
    kept = {
        .surfel = found.surfel, .slack = found.slack, .p = p, .theta = theta, .distance = distance};
    return kept.surfel;
  }
  const bool near =
      kept.surfel != nullptr && (p - kept.surfel->p).squaredNorm() < distance * distance;
  return near ? kept.surfel : nullptr;
}

PointToLine point_to_line(const LocalMap& map, const PlanarScan& scan, const Pose2& pose,
                          double distance, std::size_t stride, std::vector<Kept>& kept) {
  PointToLine sum;
  visit_pairs(map, scan, pose, distance, stride, kept, [&](const Pairing& pair) {
    double worst = 0.0;
    const double agreement = equations(pair, [&](const Vector3d& J, double e, double w) {
      sum.A.noalias() += (w * J) * J.transpose();
      sum.g += (w * e) * J;
      sum.weight += w;
      sum.arm2 += w * pair.arm.squaredNorm();
      sum.weighted_squares += w * e * e;
      worst = std::max(worst, std::abs(e));
    });
    sum.agreement += agreement;
    if (worst < kLossScale) {
      ++sum.inliers;
      sum.squares += worst * worst;
    }
  });
  return sum;
}

Directions::Directions(const PointToLine& normal, double share) : scale(1.0, 1.0, 1.0) {
  const double arm = std::sqrt(normal.arm2 / std::max(normal.weight, 1e-9));
  scale.z() = 1.0 / std::max(arm, 0.1);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(scale.asDiagonal() * normal.A *
                                                      scale.asDiagonal());
  told = eigen.eigenvalues();
  vector = eigen.eigenvectors();
  const double least = std::max(share * normal.weight, 1e-6);
  untold = static_cast<int>((told.array() < least).count());
}

Vector3d Directions::step(const Vector3d& g) const {
  Vector3d d = Vector3d::Zero();
  const Vector3d scaled = scale.cwiseProduct(g);
  for (int k = untold; k < 3; ++k) {
    d -= vector.col(k) * (vector.col(k).dot(scaled) / told[k]);
  }
  return scale.cwiseProduct(d);
}

Vector3d Directions::along_told(const Vector3d& motion) const {
  Vector3d y = motion.cwiseQuotient(scale);
  for (int k = 0; k < untold; ++k) {
    y -= vector.col(k) * vector.col(k).dot(y);
  }
  return scale.cwiseProduct(y);
}

}  // namespace thing_kin
