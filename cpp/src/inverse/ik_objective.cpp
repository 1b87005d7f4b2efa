#include "ik_objective.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "thing_kin/inverse/damped_step.hpp"
#include "thing_kin/kinematics/manipulability.hpp"

namespace thing_kin {

namespace {

constexpr int kMostSteps = 100;
constexpr double kLargestWay = std::numbers::pi / 4;

// A relative gain below this, or a step shortened so often, is the end.
constexpr double kLeastRelativeGain = 1e-10;
constexpr double kLeastPart = 1e-4;

// Iterations to come back to the target after a step beside it.
constexpr int kReturn = 6;

}  // namespace

IkMeasure::IkMeasure(const IkProblem& problem, IkObjective objective, JointVector seed) noexcept
    : problem_(problem),
      objective_(objective),
      middle_(std::move(seed)),
      mobility_(problem.mobility),
      counts_(JointVector::Ones(problem.chain.dof())) {
  if (objective != IkObjective::kLimits) {
    return;
  }
  middle_.resize(mobility_.size());
  for (Eigen::Index j = 0; j < mobility_.size(); ++j) {
    const double range = problem.chain.upper()[j] - problem.chain.lower()[j];
    const double square = range * range;
    const bool limited = std::isnormal(square);
    counts_[j] = limited ? 1.0 : 0.0;
    mobility_[j] = limited ? square : 1.0;
    middle_[j] = limited ? 0.5 * (problem.chain.upper()[j] + problem.chain.lower()[j]) : 0.0;
  }
}

double IkMeasure::operator()(const JointVector& q) const noexcept {
  if (objective_ == IkObjective::kManipulability) {
    Posture posture;
    place_joints(problem_.chain, q.data(), posture);
    return -std::log(Dexterity(problem_.chain, posture, problem_.frame).manipulability());
  }
  const JointVector way = counts_.cwiseProduct(q - middle_);
  return 0.5 * way.cwiseAbs2().cwiseQuotient(mobility_).sum();
}

JointVector IkMeasure::descent(const JointVector& q) const noexcept {
  if (objective_ != IkObjective::kManipulability) {
    return counts_.cwiseProduct(middle_ - q);
  }
  Posture posture;
  place_joints(problem_.chain, q.data(), posture);
  Hessian H;
  geometric_hessian(problem_.chain, posture, problem_.frame, ReferenceFrame::kWorldAligned, H);
  const Dexterity dexterity(problem_.chain, posture, problem_.frame);
  const double M = dexterity.manipulability();
  if (M == 0.0) {
    return JointVector::Zero(q.size());
  }
  return mobility_.cwiseProduct(dexterity.manipulability_gradient(H)) / M;
}

void improve(const IkProblem& problem, const IkMeasure& measure, IkPoint& point,
             int& iterations) noexcept {
  double value = measure(point.q);
  double part = 1.0;
  for (int i = 0; i < kMostSteps && part > kLeastPart; ++i) {
    Posture posture;
    Jacobian J;
    place_joints(problem.chain, point.q.data(), posture);
    geometric_jacobian(problem.chain, posture, problem.frame, ReferenceFrame::kWorldAligned, J);
    const JointVector way = part * measure.descent(point.q);
    IkPoint next = point;
    take_damped_step(J, problem.residual.derivative(point.value), point.value.e, measure.mobility(),
                     way.data(), {1e-12, kLargestWay}, problem.box, next.q);
    const bool reached = descend(problem, kReturn, next, iterations);
    const double gain = value - measure(next.q);
    if (!reached || !(gain > 0.0)) {
      part *= 0.3;
      continue;
    }
    point = next;
    value -= gain;
    part = std::min(measure.longest_step(), 2.0 * part);
    if (gain < kLeastRelativeGain * (std::abs(value) + kLeastRelativeGain)) {
      return;
    }
  }
}

}  // namespace thing_kin
