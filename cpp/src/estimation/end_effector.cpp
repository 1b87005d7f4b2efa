#include "thing_kin/estimation/end_effector.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin {

namespace {

// Places in q of the arm's joints, in their own order.
int arm_places(const Chain& chain, std::array<int, kMaxDof>& places) {
  int count = 0;
  for (int i = 0; i < chain.dof(); ++i) {
    const auto& base = chain.base_joints();
    if (!base || std::ranges::find(*base, i) == base->end()) {
      places[static_cast<std::size_t>(count++)] = i;
    }
  }
  return count;
}

SE3 standing(const Pose2& pose) {
  SE3 T;
  T.rotation.topLeftCorner<2, 2>() << std::cos(pose.z()), -std::sin(pose.z()), std::sin(pose.z()),
      std::cos(pose.z());
  T.translation << pose.x(), pose.y(), 0.0;
  return T;
}

// The frame after the base's own, which carries the arm.
int mount_frame(const Chain& chain) { return chain.frame_index("base") + 1; }

// The hand, the base, where the arm is mounted, and how the hand moves with each joint of the arm.
struct Hand {
  SE3 T_world_base;
  SE3 T_world_mount;
  SE3 T_world_hand;
  Jacobian arm;
};

Hand place_hand(const Chain& chain, const double* q_arm, const Pose2& base, int frame,
                const SE3& mount) {
  std::array<int, kMaxDof> places{};
  const int count = arm_places(chain, places);
  JointVector q = JointVector::Zero(chain.dof());
  for (int i = 0; i < count; ++i) {
    q[places[static_cast<std::size_t>(i)]] = q_arm[i];
  }
  Hand hand;
  hand.T_world_base = standing(base);
  SE3 T_world_root = hand.T_world_base * mount;
  hand.T_world_mount = T_world_root;
  Posture posture;
  if (chain.base_joints()) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      q[(*chain.base_joints())[static_cast<std::size_t>(i)]] = base[i];
    }
    T_world_root = SE3{};
  }
  place_joints(chain, q.data(), posture);
  if (chain.base_joints()) {
    hand.T_world_mount = frame_pose(chain, posture, mount_frame(chain));
  }
  hand.T_world_hand = T_world_root * frame_pose(chain, posture, frame);
  Jacobian all;
  geometric_jacobian(chain, posture, frame, ReferenceFrame::kWorldAligned, all);
  hand.arm.resize(6, count);
  for (int i = 0; i < count; ++i) {
    const auto column = all.col(places[static_cast<std::size_t>(i)]);
    hand.arm.col(i) << T_world_root.rotation * column.head<3>(),
        T_world_root.rotation * column.tail<3>();
  }
  return hand;
}

// Of the hand by x, y, theta of the base, world axes.
Eigen::Matrix<double, 6, 3> by_base(const Hand& hand) {
  Eigen::Matrix<double, 6, 3> J = Eigen::Matrix<double, 6, 3>::Zero();
  const Eigen::Vector3d arm = hand.T_world_hand.translation - hand.T_world_base.translation;
  J(0, 0) = 1.0;
  J(1, 1) = 1.0;
  J.col(2) << -arm.y(), arm.x(), 0.0, 0.0, 0.0, 1.0;
  return J;
}

// Of the hand by a small motion of the mount, in the axes of the base.
Matrix6 by_mount(const Hand& hand) {
  const Eigen::Matrix3d& turn = hand.T_world_base.rotation;
  const Eigen::Vector3d arm = hand.T_world_hand.translation - hand.T_world_mount.translation;
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = turn;
  J.topRightCorner<3, 3>() = -skew(arm) * turn;
  J.bottomRightCorner<3, 3>() = turn;
  return J;
}

// dQ = (0, phi) Q / 2 for a small rotation phi on the left; Q w x y z.
Eigen::Matrix<double, 4, 3> quaternion_slope(const Eigen::Vector4d& Q) {
  const Eigen::Vector3d v = Q.tail<3>();
  Eigen::Matrix<double, 4, 3> E;
  E.row(0) = -0.5 * v.transpose();
  E.bottomRows<3>() = 0.5 * (Q[0] * Eigen::Matrix3d::Identity() - skew(v));
  return E;
}

}  // namespace

int arm_dof(const Chain& chain) { return chain.dof() - (chain.base_joints() ? 3 : 0); }

EndEffector end_effector(const Chain& chain, const double* q_arm, const PlanarEstimate& base,
                         const ArmUncertainty& uncertainty, int frame, const SE3& mount) noexcept {
  const Hand hand = place_hand(chain, q_arm, base.pose, frame, mount);
  const Eigen::Matrix<double, 6, 3> J_base = by_base(hand);
  const Matrix6 J_mount = by_mount(hand);
  EndEffector result;
  result.pose = hand.T_world_hand;
  const Jacobian arm_noise = hand.arm.lazyProduct(uncertainty.joints);
  const Matrix6 alone = arm_noise.lazyProduct(hand.arm.transpose()) +
                        J_mount * uncertainty.mount * J_mount.transpose();
  const Eigen::Matrix<double, 6, 3> shared = J_base * base.covariance;
  const Matrix6 whole = alone + shared * J_base.transpose();
  result.covariance = 0.5 * (whole + whole.transpose());

  const Eigen::Vector4d Q = quaternion_from_rotation(hand.T_world_hand.rotation);
  result.task_vector << hand.T_world_hand.translation, Q, base.pose;
  Eigen::Matrix<double, 7, 6> E = Eigen::Matrix<double, 7, 6>::Zero();
  E.topLeftCorner<3, 3>().setIdentity();
  E.bottomRightCorner<4, 3>() = quaternion_slope(Q);
  result.task_covariance.topLeftCorner<7, 7>() = E * result.covariance * E.transpose();
  result.task_covariance.topRightCorner<7, 3>() = E * shared;
  result.task_covariance.bottomLeftCorner<3, 7>() = (E * shared).transpose();
  result.task_covariance.bottomRightCorner<3, 3>() = base.covariance;
  const Matrix10 S = result.task_covariance;
  result.task_covariance = 0.5 * (S + S.transpose());
  return result;
}

}  // namespace thing_kin
