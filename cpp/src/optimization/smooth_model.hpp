#pragma once

// A convex model with its l1 penalties made smooth: what a minimizer of smooth functions gets.

#include <vector>

#include "thing_kin/optimization/convex_model.hpp"

namespace thing_kin {

/// Phi(p) = g^T p + p^T B p / 2 + sum_i psi_i(value_i + (A p)_i) + prox |p - center|^2 / 2, with
/// psi_i the Moreau envelope of the distance to [lower, upper] times the penalty, of curvature
/// stiffness_i and shifted by a multiplier y_i: with w = v + y_i / stiffness_i and d its distance,
///   stiffness d^2 / 2 where d <= penalty / stiffness, else penalty d - penalty^2 / (2 stiffness).
/// Convex, once continuously differentiable, piecewise quadratic.
class SmoothModel {
 public:
  /// Refers to the model.
  explicit SmoothModel(const ConvexModel& model);

  const ConvexModel& model() const { return model_; }
  /// Of each row; infinite: a row that must hold, and psi is quadratic.
  Eigen::VectorXd& penalty() { return penalty_; }
  const Eigen::VectorXd& penalty() const { return penalty_; }
  Eigen::VectorXd& stiffness() { return stiffness_; }
  Eigen::VectorXd& multipliers() { return multipliers_; }
  const Eigen::VectorXd& stiffness() const { return stiffness_; }

  /// A quadratic term that keeps p near a center, so that flat directions have a minimizer.
  void set_proximity(double weight, const Eigen::VectorXd& center);
  double proximity() const { return proximity_; }

  /// w, (m).
  Eigen::VectorXd shifted(const VectorView& p) const;

  /// w's signed distance from its interval, (m).
  Eigen::VectorXd distance(const VectorView& p) const;

  /// d psi / d v, (m), within the penalty: the multipliers of a next iteration.
  Eigen::VectorXd pull(const VectorView& distance) const;

  double value(const VectorView& p) const;
  Eigen::VectorXd gradient(const VectorView& p) const;

  /// The step in [0, 1] from p towards q that minimizes Phi.
  double line_search(const VectorView& p, const VectorView& q) const;

  /// Of the quadratic part, the proximity included.
  const Eigen::MatrixXd& hessian() const { return hessian_; }

 private:
  const ConvexModel& model_;
  Eigen::VectorXd penalty_, stiffness_, multipliers_;
  Eigen::MatrixXd hessian_;
  Eigen::VectorXd center_;
  double proximity_ = 0.0;
};

}  // namespace thing_kin
