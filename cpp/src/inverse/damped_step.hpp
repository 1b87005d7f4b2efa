#pragma once

#include "thing_kin/inverse/joint_box.hpp"

namespace thing_kin {

struct StepDamping {
  double lambda;        ///< > 0
  double largest_turn;  ///< of any rotary joint, rad
};

/// The Levenberg-Marquardt step, 6 x 6 whatever the number of joints,
///
///     dq = z + W^-1 J^T (J W^-1 J^T + lambda I)^-1 (e - J z),
///
/// where z is what the joints would do if it were not for e, and `mobility` the diagonal of W^-1.
/// Joints that would leave the box are put on its side and the others take up what they leave.
/// q, in the box, becomes q + dq.
void take_damped_step(const Jacobian& J, const Vector6& e, const JointVector& mobility,
                      const JointVector& z, const StepDamping& damping, const JointBox& box,
                      JointVector& q) noexcept;

}  // namespace thing_kin
