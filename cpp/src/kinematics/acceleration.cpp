#include "thing_kin/kinematics/acceleration.hpp"

#include <Eigen/Geometry>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

// J x, without Eigen's general product, which may ask for workspace.
Vector6 times(const Jacobian& J, const double* x) {
  Vector6 sum = Vector6::Zero();
  for (Eigen::Index i = 0; i < J.cols(); ++i) {
    sum += x[i] * J.col(i);
  }
  return sum;
}

// A joint's twist is carried by all inside it: [V_inside, V_i]. The body's bracket with what is
// outside, summed the other way round, is the same.
Vector6 drift_of_twist(const Chain& chain, const Jacobian& J, const double* qd) {
  Vector6 inside = Vector6::Zero();
  Vector6 drift = Vector6::Zero();
  for (const Chain::Joint& joint : chain.joints()) {
    const Vector6 twist = qd[joint.index] * J.col(joint.index);
    drift += se3_bracket(inside, twist);
    inside += twist;
  }
  return drift;
}

// Coriolis 2 W_inside x v_i and centripetal w_i x v_i; W_inside x w_i.
Vector6 drift_of_point(const Chain& chain, const Jacobian& J, const double* qd) {
  Eigen::Vector3d inside = Eigen::Vector3d::Zero();
  Vector6 drift = Vector6::Zero();
  for (const Chain::Joint& joint : chain.joints()) {
    const Vector6 twist = qd[joint.index] * J.col(joint.index);
    const Eigen::Vector3d v = twist.head<3>();
    const Eigen::Vector3d w = twist.tail<3>();
    drift.head<3>() += (2.0 * inside + w).cross(v);
    drift.tail<3>() += inside.cross(w);
    inside += w;
  }
  return drift;
}

Vector6 drift_of(const Chain& chain, const Jacobian& J, ReferenceFrame reference,
                 const double* qd) {
  return reference == ReferenceFrame::kWorldAligned ? drift_of_point(chain, J, qd)
                                                    : drift_of_twist(chain, J, qd);
}

}  // namespace

AccelerationKind acceleration_kind_from_string(const std::string& name) {
  if (name == "classical") {
    return AccelerationKind::kClassical;
  }
  if (name == "spatial") {
    return AccelerationKind::kSpatial;
  }
  throw InvalidArgument("kind", quoted(name), "'classical' or 'spatial'");
}

Vector6 frame_velocity(const Chain& chain, const Posture& posture, const MovingPoint& of,
                       ReferenceFrame reference, const double* qd) noexcept {
  Jacobian J;
  geometric_jacobian(chain, posture, of, reference, J);
  return times(J, qd);
}

Vector6 frame_drift(const Chain& chain, const Posture& posture, const MovingPoint& of,
                    ReferenceFrame reference, const double* qd) noexcept {
  Jacobian J;
  geometric_jacobian(chain, posture, of, reference, J);
  return drift_of(chain, J, reference, qd);
}

Vector6 frame_acceleration(const Chain& chain, const Posture& posture, const MovingPoint& of,
                           ReferenceFrame reference, AccelerationKind kind, const double* qd,
                           const double* qdd) noexcept {
  Jacobian J;
  geometric_jacobian(chain, posture, of, reference, J);
  Vector6 acceleration = times(J, qdd) + drift_of(chain, J, reference, qd);
  const bool is_classical = reference == ReferenceFrame::kWorldAligned;
  const bool wants_classical = kind == AccelerationKind::kClassical;
  if (is_classical != wants_classical) {
    const Vector6 velocity = times(J, qd);
    const Eigen::Vector3d difference = velocity.tail<3>().cross(velocity.head<3>());
    acceleration.head<3>() += wants_classical ? difference : Eigen::Vector3d(-difference);
  }
  return acceleration;
}

}  // namespace thing_kin
