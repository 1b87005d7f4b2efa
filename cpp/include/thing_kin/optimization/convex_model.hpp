#pragma once

#include <Eigen/Core>

#include "thing_kin/core/types.hpp"

namespace thing_kin {

/// The convexified problem of Algorithm 2, of a step p from x: minimize
///   gradient^T p + p^T hessian p / 2 + penalty sum_i distance(value_i + (jacobian p)_i, bounds_i)
/// within box_lower <= p <= box_upper: trust region and bounds of the variables. All are finite but
/// lower and upper, and the box contains 0.
struct ConvexModel {
  Eigen::VectorXd gradient;              ///< (n)
  Eigen::MatrixXd hessian;               ///< (n, n), positive semidefinite
  double penalty = 1.0;                  ///< mu
  Eigen::VectorXd value;                 ///< (m)
  Eigen::MatrixXd jacobian;              ///< (m, n)
  Eigen::VectorXd lower, upper;          ///< (m), lower <= upper
  Eigen::VectorXd box_lower, box_upper;  ///< (n)

  Eigen::Index variables() const { return gradient.size(); }
  Eigen::Index rows() const { return value.size(); }
};

/// sum_i distance(value_i, [lower_i, upper_i]): the l1 violation.
inline double l1_violation(const VectorView& value, const VectorView& lower,
                           const VectorView& upper) {
  return (lower - value).cwiseMax(value - upper).cwiseMax(0.0).sum();
}

/// What the model says of a step.
inline double model_value(const ConvexModel& model, const VectorView& p) {
  return p.dot(model.gradient + 0.5 * model.hessian * p) +
         model.penalty * l1_violation(model.value + model.jacobian * p, model.lower, model.upper);
}

/// A minimizer of a convex model with the multipliers of its constraints: 0 is in the
/// subdifferential of gradient + hessian p + jacobian^T multipliers over the box.
struct ConvexStep {
  Eigen::VectorXd p;            ///< (n), in the box
  Eigen::VectorXd multipliers;  ///< (m), within the penalty; > 0: at or above the upper bound
  int iterations = 0;
};

/// How the convexified problems of Algorithm 2 are minimized.
class ConvexMinimizer {
 public:
  ConvexMinimizer() = default;
  ConvexMinimizer(const ConvexMinimizer&) = default;
  ConvexMinimizer& operator=(const ConvexMinimizer&) = default;
  ConvexMinimizer(ConvexMinimizer&&) = default;
  ConvexMinimizer& operator=(ConvexMinimizer&&) = default;
  virtual ~ConvexMinimizer() = default;

  /// A function of the model alone.
  virtual ConvexStep minimize(const ConvexModel& model) const = 0;
};

}  // namespace thing_kin
