#include "thing_kin/lie/so3.hpp"

#include <cmath>

#include "thing_kin/core/tolerance.hpp"
#include "thing_kin/lie/series.hpp"

namespace thing_kin {

namespace {

// Shepperd's method: divide by the largest component, so that none is lost to cancellation.
Eigen::Vector4d largest_pivot_quaternion(const Eigen::Matrix3d& R) {
  const double trace = R.trace();
  int largest = 0;
  R.diagonal().maxCoeff(&largest);
  Eigen::Vector4d q;
  if (trace >= R(largest, largest)) {
    q << 1.0 + trace, R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1);
  } else {
    const int i = largest;
    const int j = (i + 1) % 3;
    const int k = (j + 1) % 3;
    q[0] = R(k, j) - R(j, k);
    q[1 + i] = 1.0 + R(i, i) - R(j, j) - R(k, k);
    q[1 + j] = R(j, i) + R(i, j);
    q[1 + k] = R(k, i) + R(i, k);
  }
  return q / q.norm();
}

bool first_nonzero_is_negative(const Eigen::Vector3d& v) {
  for (const double component : v) {
    if (std::abs(component) > kHalfTurnTolerance) {
      return component < 0.0;
    }
  }
  return false;
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d S;
  S << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return S;
}

Eigen::Matrix3d so3_exp(const Eigen::Vector3d& phi_vector) {
  const double t = phi_vector.squaredNorm();
  const Eigen::Matrix3d S = skew(phi_vector);
  return Eigen::Matrix3d::Identity() + phi<1>(t) * S + phi<2>(t) * S * S;
}

Eigen::Vector3d so3_log(const Eigen::Matrix3d& R) {
  const Eigen::Vector4d q = quaternion_from_rotation(R);
  const Eigen::Vector3d v = q.tail<3>();
  const double sine = v.norm();
  // atan2(s, w)/s tends to 1/w: below this s the next term, s^2/3, is lost in rounding.
  const double half_angle_per_sine = sine < 1e-8 ? 1.0 / q[0] : std::atan2(sine, q[0]) / sine;
  return 2.0 * half_angle_per_sine * v;
}

Eigen::Matrix3d so3_left_jacobian(const Eigen::Vector3d& phi_vector) {
  const double t = phi_vector.squaredNorm();
  const Eigen::Matrix3d S = skew(phi_vector);
  return Eigen::Matrix3d::Identity() + phi<2>(t) * S + phi<3>(t) * S * S;
}

Eigen::Matrix3d so3_right_jacobian(const Eigen::Vector3d& phi_vector) {
  return so3_left_jacobian(-phi_vector);
}

Eigen::Matrix3d so3_left_jacobian_inverse(const Eigen::Vector3d& phi_vector) {
  const double t = phi_vector.squaredNorm();
  const Eigen::Matrix3d S = skew(phi_vector);
  const double c = (phi<3>(t) - 2.0 * phi<4>(t)) / (2.0 * phi<2>(t));
  return Eigen::Matrix3d::Identity() - 0.5 * S + c * S * S;
}

Eigen::Matrix3d so3_right_jacobian_inverse(const Eigen::Vector3d& phi_vector) {
  return so3_left_jacobian_inverse(-phi_vector);
}

// J_r^-1 = I + S/2 + c S^2 with S = skew(phi), S^2 = phi phi^T - t I, and phi_m' = (m phi_{m+2} -
// phi_{m+1})/2. Of a, of its e_k part: w^T skew(e_k) = (w x e_k)^T.
Eigen::Matrix3d so3_right_jacobian_inverse_derivative(const Eigen::Vector3d& phi_vector,
                                                      const Eigen::Vector3d& weights) {
  const double t = phi_vector.squaredNorm();
  const double numerator = phi<3>(t) - 2.0 * phi<4>(t);
  const double numerator_rate = 0.5 * (3.0 * phi<5>(t) - phi<4>(t)) - (4.0 * phi<6>(t) - phi<5>(t));
  const double denominator = 2.0 * phi<2>(t);
  const double denominator_rate = 2.0 * phi<4>(t) - phi<3>(t);
  const double c = numerator / denominator;
  const double c_rate = (numerator_rate - c * denominator_rate) / denominator;
  const double along = weights.dot(phi_vector);
  const Eigen::RowVector3d square = along * phi_vector.transpose() - t * weights.transpose();
  Eigen::Matrix3d N = 0.5 * skew(weights).transpose() + 2.0 * c_rate * phi_vector * square;
  N += c * (weights * phi_vector.transpose() - 2.0 * phi_vector * weights.transpose());
  N.diagonal().array() += c * along;
  return N;
}

Eigen::Vector4d quaternion_from_rotation(const Eigen::Matrix3d& R) {
  Eigen::Vector4d q = largest_pivot_quaternion(R);
  if (std::abs(q[0]) <= kHalfTurnTolerance) {
    q[0] = 0.0;
    return first_nonzero_is_negative(q.tail<3>()) ? Eigen::Vector4d(0.0, -q[1], -q[2], -q[3]) : q;
  }
  return q[0] < 0.0 ? Eigen::Vector4d(-q) : q;
}

Eigen::Matrix3d rotation_from_quaternion(const Eigen::Vector4d& wxyz) {
  const Eigen::Vector4d q = wxyz / wxyz.stableNorm();
  const Eigen::Matrix3d S = skew(q.tail<3>());
  return Eigen::Matrix3d::Identity() + 2.0 * q[0] * S + 2.0 * S * S;
}

Eigen::Matrix3d rotation_from_rpy(const Eigen::Vector3d& rpy) {
  const double cr = std::cos(rpy[0]);
  const double sr = std::sin(rpy[0]);
  const double cp = std::cos(rpy[1]);
  const double sp = std::sin(rpy[1]);
  const double cy = std::cos(rpy[2]);
  const double sy = std::sin(rpy[2]);
  Eigen::Matrix3d R;
  R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
      -sp, cp * sr, cp * cr;
  return R;
}

Eigen::Vector3d rpy_from_rotation(const Eigen::Matrix3d& R) {
  const double cp = std::hypot(R(2, 1), R(2, 2));
  // Adding zero makes -0 a 0, so that half a turn is pi and not -pi.
  const double roll = cp <= kGimbalLockTolerance ? 0.0 : std::atan2(R(2, 1) + 0.0, R(2, 2));
  const double pitch = std::atan2(-R(2, 0), cp);
  // The second column of R Rx(-roll) = Rz(yaw) Ry(pitch) is (-sin(yaw), cos(yaw), 0): near
  // |pitch| = pi/2, where roll has few digits, yaw makes up for them.
  const Eigen::Vector3d y = std::cos(roll) * R.col(1) - std::sin(roll) * R.col(2);
  return {roll, pitch, std::atan2(0.0 - y[0], y[1])};
}

}  // namespace thing_kin
