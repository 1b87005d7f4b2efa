#include "thing_kin/kinematics/hessian.hpp"

#include <Eigen/Geometry>

namespace thing_kin {

namespace {

using Column = Vector6;

Eigen::Vector3d linear(const Column& c) { return c.head<3>(); }
Eigen::Vector3d angular(const Column& c) { return c.tail<3>(); }

Column stack(const Eigen::Vector3d& v, const Eigen::Vector3d& w) {
  Column c;
  c << v, w;
  return c;
}

// Columns i and k of J; `k_first`: joint k is no further from the root than joint i.
//
// World-aligned: an inner joint turns everything that is further out; an outer one moves the point.
Column world_aligned(const Column& Ji, const Column& Jk, bool k_first) {
  if (k_first) {
    const Eigen::Vector3d w = angular(Jk);
    return stack(w.cross(linear(Ji)), w.cross(angular(Ji)));
  }
  return stack(angular(Ji).cross(linear(Jk)), Eigen::Vector3d::Zero());
}

// dJ_i/dq_k is [J_k, J_i] for k inside i in the spatial frame, [J_i, J_k] for k outside i in the
// body frame, and zero else.
Column derivative(ReferenceFrame reference, const Column& Ji, const Column& Jk, bool k_first) {
  switch (reference) {
    case ReferenceFrame::kWorldAligned:
      return world_aligned(Ji, Jk, k_first);
    case ReferenceFrame::kWorld:
      return k_first ? se3_bracket(Jk, Ji) : Column::Zero();
    case ReferenceFrame::kBody:
      break;
  }
  return k_first ? Column::Zero() : se3_bracket(Ji, Jk);
}

}  // namespace

void geometric_hessian(const Chain& chain, const Posture& posture, const MovingPoint& of,
                       ReferenceFrame reference, Hessian& H) noexcept {
  Jacobian J;
  geometric_jacobian(chain, posture, of, reference, J);
  const auto joints = chain.joints();
  const std::size_t n = joints.size();
  for (std::size_t k = 0; k < n; ++k) {
    const int index_k = joints[k].index;
    Jacobian& Hk = H[static_cast<std::size_t>(index_k)];
    Hk.resize(6, chain.dof());
    for (std::size_t i = 0; i < n; ++i) {
      const int index_i = joints[i].index;
      Hk.col(index_i) = derivative(reference, J.col(index_i), J.col(index_k), k <= i);
    }
  }
}

}  // namespace thing_kin
