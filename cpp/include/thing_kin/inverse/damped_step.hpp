#pragma once

#include "thing_kin/inverse/joint_box.hpp"
#include "thing_kin/kinematics/damped_inverse.hpp"

namespace thing_kin {

struct StepDamping {
  double lambda;        ///< > 0
  double largest_turn;  ///< of any rotary joint, rad
};

/// The Levenberg-Marquardt step towards M J dq = e within the box,
///
///     dq = z + W^-1 A^T (A W^-1 A^T + lambda I)^-1 (e - A z),  A = M J,
///
/// where z is what the joints would do if it were not for e (null: nothing), and `mobility` the
/// diagonal of W^-1. Joints that would leave the box are put on its side and the others take up
/// what they leave. q, in the box, becomes q + dq.
void take_damped_step(const Jacobian& J, const RowFactors& M, Vector6 e,
                      const JointVector& mobility, const double* z, const StepDamping& damping,
                      const JointBox& box, JointVector& q) noexcept;

}  // namespace thing_kin
