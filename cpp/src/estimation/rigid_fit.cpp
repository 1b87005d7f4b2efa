#include "rigid_fit.hpp"

#include <Eigen/LU>

#include "thing_kin/linalg/svd.hpp"

namespace thing_kin {

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& M) {
  Svd svd;
  decompose(M, svd);
  const Eigen::Matrix3d U = svd.u;
  const Eigen::Matrix3d V = svd.v;
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  sign.z() = U.determinant() * V.determinant() < 0.0 ? -1.0 : 1.0;
  return U * sign.asDiagonal() * V.transpose();
}

SE3 fitted_motion(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to,
                  const Eigen::VectorXd& weights) {
  const double total = weights.sum();
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    a += weights[i] / total * from.col(i);
    b += weights[i] / total * to.col(i);
  }
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    M += weights[i] * (to.col(i) - b) * (from.col(i) - a).transpose();
  }
  const Eigen::Matrix3d R = nearest_rotation(M);
  return {R, b - R * a};
}

}  // namespace thing_kin
