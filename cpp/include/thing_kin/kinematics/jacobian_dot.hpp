#pragma once

#include "thing_kin/kinematics/jacobian.hpp"

namespace thing_kin {

/// Time derivative of the geometric Jacobian along the joint velocities qd (n), rad/s and m/s:
/// sum_k dJ/dq_k qd_k in O(n), without the Hessian. Not in the theses.
void geometric_jacobian_dot(const Chain& chain, const Posture& posture, const MovingPoint& of,
                            ReferenceFrame reference, const double* qd, Jacobian& dJ) noexcept;

}  // namespace thing_kin
