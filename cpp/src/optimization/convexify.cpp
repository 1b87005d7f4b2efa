#include "thing_kin/optimization/convexify.hpp"

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Curvature below this is lifted to it, relative to the largest: it keeps the substitute's
// conditioning where doubles can handle it.
constexpr double kLeastEigenvalue = 1e-8;
constexpr double kMostAcross = 1e8;

MatrixXd lifted(const MatrixXd& H, double least) {
  if (H.size() == 0) {
    return H;
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(H);
  const VectorXd d = eigen.eigenvalues().cwiseMax(least);
  return eigen.eigenvectors() * d.asDiagonal() * eigen.eigenvectors().transpose();
}

double least_eigenvalue(const MatrixXd& S) {
  if (S.size() == 0) {
    return 0.0;
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(0.5 * (S + S.transpose()),
                                                      Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[0];
}

}  // namespace

ConvexQuadratic without_negative_curvature(const MatrixView& H) {
  return {lifted(H, 0.0), VectorXd::Zero(H.rows())};
}

std::optional<ConvexQuadratic> convex_across(const MatrixView& H, const MatrixView& C,
                                             const VectorView& c) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(C.transpose());
  const Index rank = qr.rank();
  const MatrixXd Q = qr.householderQ();
  const MatrixXd Y = Q.leftCols(rank);
  const MatrixXd Z = Q.rightCols(Q.cols() - rank);
  const double largest = std::max(1e-8, H.cwiseAbs().maxCoeff());
  const double least = kLeastEigenvalue * largest;

  MatrixXd within = Z.transpose() * H * Z;
  within = lifted(0.5 * (within + within.transpose()), least);
  MatrixXd across = Y.transpose() * H * Y;
  if (Z.cols() > 0) {
    const MatrixXd cross = Z.transpose() * H * Y;
    across -= cross.transpose() * within.llt().solve(cross);
  }
  const double sigma = std::max(0.0, least - least_eigenvalue(across));
  if (!(sigma <= kMostAcross * largest)) {
    return std::nullopt;
  }
  ConvexQuadratic convex;
  convex.hessian = H + Z * (within - Z.transpose() * H * Z) * Z.transpose();
  convex.hessian += sigma * Y * Y.transpose();
  convex.hessian = lifted(0.5 * (convex.hessian + convex.hessian.transpose()), 0.0);
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> rows(C);
  convex.slope = sigma * rows.solve(c);
  return convex;
}

}  // namespace thing_kin
