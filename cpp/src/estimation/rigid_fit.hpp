#pragma once

#include "thing_kin/lie/se3.hpp"

namespace thing_kin {

/// The rotation that is nearest to M.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& M);

/// The rigid motion that takes the columns of `from` to those of `to` best, by weighted least
/// squares (Procrustes).
SE3 fitted_motion(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to,
                  const Eigen::VectorXd& weights);

}  // namespace thing_kin
