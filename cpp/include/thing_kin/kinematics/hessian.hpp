#pragma once

#include <array>

#include "thing_kin/kinematics/jacobian.hpp"

namespace thing_kin {

/// Derivatives of a Jacobian: H[k] = dJ/dq_k, (6, n) each.
using Hessian = std::array<Jacobian, kMaxDof>;

/// Exact derivative of the geometric Jacobian of a point, in any reference frame.
void geometric_hessian(const Chain& chain, const Posture& posture, const MovingPoint& of,
                       ReferenceFrame reference, Hessian& H) noexcept;

}  // namespace thing_kin
