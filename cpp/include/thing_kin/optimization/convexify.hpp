#pragma once

#include <optional>

#include <Eigen/Core>

#include "thing_kin/core/types.hpp"

namespace thing_kin {

/// A convex function slope^T p + p^T hessian p / 2 in place of p^T H p / 2.
struct ConvexQuadratic {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd slope;
};

/// H without its negative eigenvalues.
ConvexQuadratic without_negative_curvature(const MatrixView& H);

/// For a step that is to meet C p = -c (the constraints that hold it, linearized): the same step in
/// a convex problem. H loses negative curvature only on the null space of C; across it sigma
/// |Y^T (p - p_c)|^2 / 2 is added, Y an orthonormal basis of C's rows and p_c the shortest p with
/// C p = -c, which says nothing new of a step that meets it. So a nonconvex Lagrangian costs no
/// quadratic convergence. None: sigma would be out of proportion.
std::optional<ConvexQuadratic> convex_across(const MatrixView& H, const MatrixView& C,
                                             const VectorView& c);

}  // namespace thing_kin
