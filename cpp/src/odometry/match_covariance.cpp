#include "match_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "thing_kin/linalg/spd.hpp"

namespace thing_kin {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Points further apart, m, are of two things.
constexpr double kRunGap = 0.3;
// So much of a thing is left out to see what hangs on it: where it alone tells a direction
// something must stay.
constexpr double kLeftOut = 0.95;
// Fits closer than this, m and rad, are one.
constexpr double kSameFit = 0.02;
// A fit that is off by more than this quantile of the covariance is another (chi square, 3 dof,
// 95 %).
constexpr double kOtherFit = 7.815;
// Where people walk the best fit of two is the wrong one in half of the cases if both are equal; if
// the other's merit is so much less, in hardly any. In worlds that stand still it hardly ever is.
constexpr double kRivalMerit = 0.12;
// What a covariance of no rank lacks.
constexpr double kTiny = 1e-12;

// What a row of neighboring points asks for together: an error of that thing, which does not
// average out.
struct Cluster {
  Matrix3d A = Matrix3d::Zero();
  Vector3d force = Vector3d::Zero();

  // What it moves the fit by: the others alone would lie elsewhere.
  Vector3d pull(const Matrix3d& all) const {
    return all * (all - kLeftOut * A).ldlt().solve(force);
  }
};

// In each direction the larger of two covariances, by the first one's measure.
Matrix3d larger(const Matrix3d& a, const Matrix3d& b) {
  const Eigen::LLT<Matrix3d> root(a + Matrix3d::Identity() * (kTiny * a.trace() + kTiny));
  const Matrix3d L = root.matrixL();
  const Matrix3d half = root.matrixL().solve(b);
  const Matrix3d ratio = root.matrixL().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(ratio);
  const Matrix3d axes = L * eigen.eigenvectors();
  return axes * eigen.eigenvalues().cwiseMax(1.0).asDiagonal() * axes.transpose();
}

}  // namespace

MatchSpread spread_of(const LocalMap& map, const PlanarScan& scan, const Pose2& pose,
                      const PointToLine& normal, double noise, std::vector<Kept>& kept,
                      std::vector<int>& hits) {
  assign_with_room(hits, map.surfels().size(), 0);
  const auto index = [&](const Surfel* surfel) {
    return static_cast<std::size_t>(surfel - map.surfels().data());
  };
  visit_pairs(map, scan, pose, kLastDistance, 1, kept,
              [&](const Pairing& pair) { ++hits[index(pair.surfel)]; });
  MatchSpread spread;
  Matrix3d of_noise = Matrix3d::Zero();
  Cluster cluster;
  const Matrix3d all = normal.A + Matrix3d::Identity() * (1e-6 * normal.A.trace() + 1e-9);
  const auto end_cluster = [&] {
    const Vector3d pull = cluster.pull(all);
    spread.B += pull * pull.transpose();
    cluster = {};
  };
  Vector2d last = Vector2d::Zero();
  visit_pairs(map, scan, pose, kLastDistance, 1, kept, [&](const Pairing& pair) {
    if ((pair.arm - last).squaredNorm() > kRunGap * kRunGap) {
      end_cluster();
    }
    last = pair.arm;
    // Points that share a surfel share its noise.
    const double shared = hits[index(pair.surfel)] / pair.surfel->weight;
    const double behind = pair.surfel->line_normal.dot(pair.surfel->p - pair.surfel->line_p);
    equations(pair, [&](const Vector3d& J, double e, double w) {
      of_noise.noalias() += (w * w * (1.0 + shared)) * J * J.transpose();
      cluster.A.noalias() += w * J * J.transpose();
      cluster.force += w * e * J;
      spread.pull += w * behind * J;
    });
  });
  end_cluster();
  const double mean_square = normal.weighted_squares / std::max(normal.weight, 1e-9);
  spread.B = larger(of_noise * std::max(noise * noise, mean_square), spread.B);
  return spread;
}

void write_covariance(const Matrix3d& B, const Directions& told, const Matrix3d& guess,
                      ScanMatch& match) {
  const Matrix3d B_scaled = told.scale.asDiagonal() * B * told.scale.asDiagonal();
  Matrix3d inverse = Matrix3d::Zero();
  for (int k = told.untold; k < 3; ++k) {
    inverse += told.vector.col(k) * told.vector.col(k).transpose() / told.told[k];
  }
  Matrix3d P = inverse * B_scaled * inverse;
  Matrix3d P_scan = P;
  const Vector3d unit = told.scale.cwiseInverse();
  for (int k = 0; k < told.untold; ++k) {
    const Vector3d v = told.vector.col(k);
    const Vector3d there = unit.cwiseProduct(v);
    P += v * v.transpose() * there.dot(guess * there);
    P_scan += v * v.transpose() * kUntoldVariance;
    match.untold.col(k) = v;
  }
  match.degenerate = told.untold;
  match.arm = unit.z();
  for (int i = 0; i < 3; ++i) {
    match.told.col(i) = told.along_told(Vector3d::Unit(i));
  }
  const auto in_units = [&](const Matrix3d& scaled) {
    Matrix3d out = told.scale.asDiagonal() * scaled * told.scale.asDiagonal();
    out = (0.5 * (out + out.transpose())).eval();
    if (!is_positive(out)) {
      const Vector3d sizes = out.diagonal().cwiseMax(0.0);
      keep_positive(out, sizes);
    }
    return out;
  };
  match.covariance = in_units(P);
  match.scan_covariance = in_units(P_scan);
}

void span_rivals(const std::vector<Rival>& fits, double merit, ScanMatch& match) {
  const Eigen::LDLT<Matrix3d> inverse(match.covariance);
  Matrix3d between = Matrix3d::Zero();
  double total = 1.0;
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const double rest = 1.0 - std::max(merit - fits[k].merit, 0.0) / kRivalMerit;
    const Vector3d off = match.told * pose_difference(fits[k].pose, match.pose);
    const bool known = std::any_of(
        fits.begin(), std::next(fits.begin(), static_cast<std::ptrdiff_t>(k)),
        [&](const Rival& other) {
          return pose_difference(fits[k].pose, other.pose).cwiseAbs().maxCoeff() < kSameFit;
        });
    if (rest > 0.0 && !known && off.dot(inverse.solve(off)) > kOtherFit) {
      total += rest * rest;
      between += rest * rest * off * off.transpose();
    }
  }
  match.ambiguous = total > 1.0;
  match.covariance += between / total;
  match.scan_covariance += between / total;
}

}  // namespace thing_kin
