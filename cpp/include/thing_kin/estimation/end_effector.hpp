#pragma once

#include <Eigen/Core>

#include "thing_kin/kinematics/task_vector.hpp"
#include "thing_kin/odometry/planar_motion.hpp"

namespace thing_kin {

using Matrix10 = Eigen::Matrix<double, 10, 10>;

/// The hand and how well it is known. Covariances are [position, rotation] in the axes of the
/// world, the small rotation on the left: R = exp(phi) R_mean.
struct EndEffector {
  SE3 pose;
  Matrix6 covariance = Matrix6::Zero();
  Eigen::Matrix<double, 10, 1> task_vector = Eigen::Matrix<double, 10, 1>::Zero();
  Matrix10 task_covariance =
      Matrix10::Zero();  ///< positive semidefinite: a quaternion is of norm 1
};

/// What is known beside the base: covariance of the arm's joints (in the order of its own joints)
/// and of where the arm is mounted, [position, rotation] in the axes of the base.
struct ArmUncertainty {
  SmallMatrix joints;
  Matrix6 mount = Matrix6::Zero();
};

/// Number of joints of the arm alone: of a chain on an omnidirectional base three less.
int arm_dof(const Chain& chain);

/// Pose of a frame with its covariance to first order, and the task vector [M17] (3.5) of it and
/// the base. The base stands in for the chain's own x, y, theta; a chain without them stands on it
/// at `mount` (ignored otherwise). `q_arm` has arm_dof(chain) finite entries.
EndEffector end_effector(const Chain& chain, const double* q_arm, const PlanarEstimate& base,
                         const ArmUncertainty& uncertainty, int frame,
                         const SE3& mount = {}) noexcept;

}  // namespace thing_kin
