#include "thing_kin/odometry/planar_motion.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace thing_kin {

Eigen::Matrix3d default_twist_covariance() {
  return Eigen::Vector3d(0.001, 0.001, 0.03).asDiagonal();
}

Pose2 integrate_twist(const Pose2& pose, const Twist2& twist, double dt) noexcept {
  return compose(pose, se2_exp(twist * dt));
}

MotionJacobians motion_jacobians(const Pose2& pose, const Twist2& xi) noexcept {
  const Pose2 step = se2_exp(xi);
  const double c = std::cos(pose.z());
  const double s = std::sin(pose.z());
  MotionJacobians J;
  J.by_pose.setIdentity();
  J.by_pose(0, 2) = -s * step.x() - c * step.y();
  J.by_pose(1, 2) = c * step.x() - s * step.y();
  // exp(xi + d) = exp(xi) exp(J_r d), and a small motion of the end is turned into the world.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(pose.z() + xi.z()).toRotationMatrix();
  J.by_motion.noalias() = turn * se2_right_jacobian(xi);
  return J;
}

void move(PlanarEstimate& estimate, const Twist2& xi, const Eigen::Matrix3d& covariance) noexcept {
  const MotionJacobians J = motion_jacobians(estimate.pose, xi);
  const Eigen::Matrix3d P = J.by_pose * estimate.covariance * J.by_pose.transpose() +
                            J.by_motion * covariance * J.by_motion.transpose();
  estimate.covariance = 0.5 * (P + P.transpose());
  estimate.pose = compose(estimate.pose, se2_exp(xi));
}

void dead_reckon(const PlanarEstimate& start, std::span<const NoisyMotion> motions,
                 const Eigen::Matrix3d& covariance, std::span<PlanarEstimate> out) noexcept {
  out[0] = start;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    out[i + 1] = out[i];
    move(out[i + 1], motions[i].xi, covariance * motions[i].noise);
  }
}

}  // namespace thing_kin
