#pragma once

#include "thing_kin/core/types.hpp"
#include "thing_kin/model/chain.hpp"

namespace thing_kin {

/// H += sum_i weights_i d^2 x_i/dq^2, where x(dq) is the pose error [linear, angular] from the pose
/// at q to that at q + dq, at dq = 0: what a pose held by a multiplier adds to the Lagrangian's
/// Hessian. J: the world-aligned Jacobian at q.
void add_pose_curvature(const Chain& chain, const Jacobian& J, const Vector6& weights,
                        SmallMatrix& H) noexcept;

/// The same along the columns of Z (n, k) only: H (k, k) += Z^T (...) Z.
void add_pose_curvature_along(const Chain& chain, const Jacobian& J, const Vector6& weights,
                              const SmallMatrix& Z, SmallMatrix& H) noexcept;

}  // namespace thing_kin
