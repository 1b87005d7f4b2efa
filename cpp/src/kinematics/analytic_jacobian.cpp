#include "thing_kin/kinematics/analytic_jacobian.hpp"

#include <cmath>
#include <numbers>

#include "thing_kin/core/tolerance.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin {

namespace {

using Rates = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, 4, 3>;

// dQ/dt = (0, w) Q / 2, w in the axes of the root.
void quaternion_rates(const Eigen::Matrix3d& R, Rates& E) {
  const Eigen::Vector4d Q = quaternion_from_rotation(R);
  const Eigen::Vector3d v = Q.tail<3>();
  E.resize(4, 3);
  E.row(0) = -0.5 * v.transpose();
  E.bottomRows<3>() = 0.5 * (Q[0] * Eigen::Matrix3d::Identity() - skew(v));
}

// The inverse of w = yaw' z + pitch' Rz(yaw) y + roll' Rz(yaw) Ry(pitch) x.
bool rpy_rates(const Eigen::Matrix3d& R, Rates& E) {
  const Eigen::Vector3d rpy = rpy_from_rotation(R);
  if (std::numbers::pi / 2 - std::abs(rpy[1]) <= kQuarterTurnMargin) {
    return false;
  }
  const double cy = std::cos(rpy[2]);
  const double sy = std::sin(rpy[2]);
  const double cp = std::cos(rpy[1]);
  const double sp = std::sin(rpy[1]);
  E.resize(3, 3);
  E << cy / cp, sy / cp, 0.0,  //
      -sy, cy, 0.0,            //
      cy * sp / cp, sy * sp / cp, 1.0;
  return true;
}

// `more` rows are left for the caller.
bool fill(const Chain& chain, const Posture& posture, const MovingPoint& of,
          Orientation orientation, Eigen::Index more, AnalyticJacobian& J) {
  const Eigen::Matrix3d R = frame_pose(chain, posture, of.frame).rotation;
  Rates E;
  if (orientation == Orientation::kQuaternion) {
    quaternion_rates(R, E);
  } else if (!rpy_rates(R, E)) {
    return false;
  }
  Jacobian G;
  geometric_jacobian(chain, posture, of, ReferenceFrame::kWorldAligned, G);
  J.resize(3 + E.rows() + more, G.cols());
  for (Eigen::Index i = 0; i < G.cols(); ++i) {
    J.col(i).head<3>() = G.col(i).head<3>();
    // In this order for any J, so that the two functions below agree to the last digit.
    J.col(i).segment(3, E.rows()) = E.col(0) * G(3, i) + E.col(1) * G(4, i) + E.col(2) * G(5, i);
  }
  return true;
}

}  // namespace

bool analytic_jacobian(const Chain& chain, const Posture& posture, const MovingPoint& of,
                       Orientation orientation, AnalyticJacobian& J) noexcept {
  return fill(chain, posture, of, orientation, 0, J);
}

bool task_jacobian(const Chain& chain, const Posture& posture, Orientation orientation,
                   AnalyticJacobian& J) noexcept {
  if (!fill(chain, posture, chain.tool(), orientation, 3, J)) {
    return false;
  }
  J.bottomRows<3>().setZero();
  for (int i = 0; i < 3; ++i) {
    J(J.rows() - 3 + i, (*chain.base_joints())[static_cast<std::size_t>(i)]) = 1.0;
  }
  return true;
}

}  // namespace thing_kin
