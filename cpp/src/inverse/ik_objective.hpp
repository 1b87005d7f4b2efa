#pragma once

#include "thing_kin/inverse/ik_descent.hpp"
#include "thing_kin/inverse/numeric_ik.hpp"

namespace thing_kin {

/// What is to be small among the solutions of one target, with its gradient and the metric in which
/// its descent is steepest.
class IkMeasure {
 public:
  /// seed is read by kSeed alone.
  IkMeasure(const IkProblem& problem, IkObjective objective, JointVector seed) noexcept;

  double operator()(const JointVector& q) const noexcept;

  /// The way of steepest descent in the metric, with no regard to the target.
  JointVector descent(const JointVector& q) const noexcept;

  /// How much longer than the descent a step may be: a quadratic's is Newton's, and needs no more.
  double longest_step() const { return objective_ == IkObjective::kManipulability ? 64.0 : 1.0; }

  /// The inverse of the metric, a diagonal.
  const JointVector& mobility() const { return mobility_; }

 private:
  const IkProblem& problem_;
  IkObjective objective_;
  JointVector middle_;  // what q is drawn to, for kSeed and kLimits
  JointVector mobility_;
  JointVector counts_;  // 1 or 0: whether the joint is drawn
};

/// Moves point, which is at the target, along the solutions to a local minimum of the measure;
/// stays within tolerance of the target and in the box. Iterations are added.
void improve(const IkProblem& problem, const IkMeasure& measure, IkPoint& point,
             int& iterations) noexcept;

}  // namespace thing_kin
