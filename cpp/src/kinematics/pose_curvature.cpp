#include "thing_kin/kinematics/pose_curvature.hpp"

#include <Eigen/Geometry>

namespace thing_kin {

// d^2 p is w_a x v_b for a no further out than b. That of the rotation's logarithm at zero is the
// symmetric part of dw_b/dq_a = w_a x w_b: half of it on each side of the diagonal.
void add_pose_curvature(const Chain& chain, const Jacobian& J, const Vector6& weights,
                        SmallMatrix& H) noexcept {
  const auto joints = chain.joints();
  const Eigen::Vector3d force = weights.head<3>();
  const Eigen::Vector3d torque = 0.5 * weights.tail<3>();
  for (std::size_t a = 0; a < joints.size(); ++a) {
    const int i = joints[a].index;
    const Eigen::Vector3d w = J.col(i).tail<3>();
    const Eigen::Vector3d force_w = force.cross(w);  // f . (w x v) = (f x w) . v
    const Eigen::Vector3d torque_w = torque.cross(w);
    for (std::size_t b = a; b < joints.size(); ++b) {
      const int j = joints[b].index;
      const double value = force_w.dot(J.col(j).head<3>()) + torque_w.dot(J.col(j).tail<3>());
      H(i, j) += value;
      if (i != j) {
        H(j, i) += value;
      }
    }
  }
}

// z^T S z' = S_z . z' + S_z' . z with S_z of the entries before the diagonal, which are sums on the
// way out, and half of it.
void add_pose_curvature_along(const Chain& chain, const Jacobian& J, const Vector6& weights,
                              const SmallMatrix& Z, SmallMatrix& H) noexcept {
  const auto joints = chain.joints();
  const Eigen::Vector3d force = weights.head<3>();
  const Eigen::Vector3d torque = 0.5 * weights.tail<3>();
  for (Eigen::Index k = 0; k < Z.cols(); ++k) {
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    SmallVector along = SmallVector::Zero(Z.cols());  // S_z of column k, along each column
    for (const Chain::Joint& joint : joints) {
      const int j = joint.index;
      const auto v = J.col(j).head<3>();
      const auto w = J.col(j).tail<3>();
      const Eigen::Vector3d before = turn + 0.5 * Z(j, k) * w;
      const double share = force.cross(before).dot(v) + torque.cross(turn).dot(w);
      turn += Z(j, k) * w;
      for (Eigen::Index l = 0; l < Z.cols(); ++l) {
        along[l] += share * Z(j, l);
      }
    }
    for (Eigen::Index l = 0; l < Z.cols(); ++l) {
      H(k, l) += along[l];
      H(l, k) += along[l];
    }
  }
}

}  // namespace thing_kin
