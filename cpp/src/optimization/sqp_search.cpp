#include "sqp_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "thing_kin/core/tolerance.hpp"
#include "thing_kin/optimization/optimality.hpp"

namespace thing_kin {

namespace {

using Eigen::VectorXd;

constexpr int kMostWorse = 5;
constexpr double kLeastOfPenalty = 1e-3;
constexpr double kLeastOfViolation = 1e-6;
constexpr int kPolishes = 10;         // in a row
constexpr double kPolishRise = 1e-8;  // of the objective, relative

}  // namespace

SqpSearch::SqpSearch(const Problem& problem, const ConvexMinimizer& minimizer,
                     const SqpOptions& options, const VectorView& x0)
    : problem_(problem),
      minimizer_(minimizer),
      options_(options),
      x_(x0),
      multipliers_(VectorXd::Zero(problem.rows())),
      merit_{1.0, options.mu0, 0.0},
      delta_(options.delta0) {}

bool SqpSearch::penalty_loop() {
  if (!problem_.linearize(x_, at_)) {
    return true;
  }
  double violation = std::numeric_limits<double>::infinity();
  for (;;) {
    const End end = convexify_loop();
    if (end != End::kStationary || is_feasible() || merit_.penalty >= options_.mu_max) {
      return true;
    }
    const double left = largest_violation();
    if (left > 0.1 * violation && !restore()) {
      return false;
    }
    violation = left;
    merit_.penalty = std::min(options_.mu_max, options_.k * merit_.penalty);
    delta_ = options_.delta0;
  }
}

SqpSearch::End SqpSearch::convexify_loop() {
  int worse = 0;  // steps in a row
  while (!out_of_budget()) {
    if (is_optimal()) {
      return End::kOptimal;
    }
    const double before = largest_violation();
    const bool has_moved = trust_loop();
    if (!has_moved && !out_of_budget()) {
      return End::kStationary;
    }
    // Under too small a penalty the merit may have no minimum at all.
    worse = !is_feasible() && largest_violation() > before ? worse + 1 : 0;
    if (worse == kMostWorse) {
      return End::kStationary;
    }
  }
  return End::kBudget;
}

// True: x has moved.
bool SqpSearch::trust_loop() {
  Model model = convexify(Convexity::kAcross);
  while (delta_ >= options_.delta_min && !out_of_budget()) {
    ++iterations_;
    Trial trial = attempt(model, model.convex);
    const double step = trial.step.p.cwiseAbs().maxCoeff();
    const bool is_small =
        !(trial.predicted > least_improvement()) || step <= options_.step_tolerance;
    if (!is_small && !is_acceptable(trial) && options_.second_order_correction) {
      trial = corrected(model, trial);
    }
    const bool improves = is_small
                              ? trial.actual >= -rounding() && step > 0.0 && polished_ < kPolishes
                              : is_acceptable(trial);
    if ((improves || is_polish(trial)) && move(trial)) {
      const bool is_told = !is_small && trial.actual >= options_.c * trial.predicted;
      polished_ = is_told ? 0 : polished_ + 1;
      delta_ = std::min(options_.delta_max, options_.tau_plus * delta_);
      return true;
    }
    note(false);
    if (is_small && model.is_clipped) {
      return false;
    }
    delta_ = is_small ? delta_ : options_.tau_minus * std::min(delta_, step);
    model = convexify(Convexity::kClipped);
  }
  return false;
}

// The violation alone, by the same loops: its sum, and where that is at a minimum above zero the
// sum of squares, which has others.
bool SqpSearch::restore() {
  constexpr Merit kSum{0.0, 1.0, 0.0};
  constexpr Merit kSquares{0.0, 0.0, 1.0};
  const Merit merit = merit_;
  for (const Merit& one : {kSum, kSquares, kSum}) {
    merit_ = one;
    multipliers_.setZero();
    delta_ = options_.delta0;
    if (!is_feasible() && !out_of_budget()) {
      convexify_loop();
    }
  }
  merit_ = merit;
  multipliers_.setZero();
  return is_feasible() || out_of_budget();
}

SqpSearch::Trial SqpSearch::attempt(const Model& model, const ConvexModel& solved) const {
  Trial trial{minimizer_.minimize(solved), {}, 0.0, 0.0};
  const VectorXd& p = trial.step.p;
  trial.x = (x_ + p).cwiseMax(problem_.lower()).cwiseMin(problem_.upper());
  const auto penalty = [&](const VectorXd& value) {
    return merit_.penalty * l1_violation(value, problem_.row_lower(), problem_.row_upper());
  };
  trial.predicted = -p.dot(model.gradient + 0.5 * model.hessian * p) + penalty(at_.value) -
                    penalty(at_.value + at_.jacobian * p);
  double objective = 0.0;
  VectorXd value;
  trial.actual = problem_.evaluate(trial.x, objective, value)
                     ? merit() - merit(objective, value)
                     : -std::numeric_limits<double>::infinity();
  return trial;
}

// Fletcher's second-order correction: the constraints' curvature as it shows at the step's end.
SqpSearch::Trial SqpSearch::corrected(const Model& model, const Trial& first) const {
  double objective = 0.0;
  ConvexModel again = model.convex;
  if (again.rows() == 0 || !problem_.evaluate(first.x, objective, again.value)) {
    return first;
  }
  again.value -= at_.jacobian * first.step.p;
  Trial trial = attempt(model, again);
  trial.predicted = first.predicted;
  return is_acceptable(trial) ? trial : first;
}

bool SqpSearch::is_acceptable(const Trial& trial) const {
  return trial.predicted > 0.0 && (trial.actual >= options_.c * trial.predicted ||
                                   (trial.predicted <= 10.0 * rounding() &&
                                    trial.actual >= -rounding() && polished_ < kPolishes));
}

// Near the end the merit cannot tell: with a large penalty, a violation within tolerance outweighs
// what the objective gains. There the residual decides, from one feasible point to the next.
bool SqpSearch::is_polish(const Trial& trial) const {
  Linearization there;
  if (merit_.scale == 0.0 || polished_ >= kPolishes || !is_feasible() ||
      !problem_.linearize(trial.x, there) ||
      (problem_.row_violations(there.value).array() > options_.constraint_tolerance).any()) {
    return false;
  }
  return there.objective - at_.objective <= kPolishRise * std::max(1.0, std::abs(at_.objective)) &&
         optimality(problem_, trial.x, there).residual <
             0.5 * optimality(problem_, x_, at_).residual;
}

// False: a derivative does not exist where the value does.
bool SqpSearch::move(const Trial& trial) {
  Linearization there;
  if (!problem_.linearize(trial.x, there)) {
    return false;
  }
  note(true);
  x_ = trial.x;
  at_ = std::move(there);
  if (merit_.squares == 0.0) {
    multipliers_ = trial.step.multipliers;
  }
  return true;
}

void SqpSearch::note(bool accepted) {
  trace_.merit.push_back(merit());
  trace_.objective.push_back(at_.objective);
  trace_.violation.push_back(largest_violation());
  trace_.radius.push_back(delta_);
  trace_.penalty.push_back(merit_.penalty);
  trace_.accepted.push_back(accepted);
}

double SqpSearch::largest_violation() const {
  return problem_.rows() == 0 ? 0.0 : problem_.row_violations(at_.value).maxCoeff();
}

bool SqpSearch::is_feasible() const { return largest_violation() <= options_.constraint_tolerance; }

bool SqpSearch::is_optimal() const {
  return is_feasible() && (merit_.scale == 0.0 ||
                           optimality(problem_, x_, at_).residual <= options_.optimality_tolerance);
}

// Positive above the upper bound.
VectorXd SqpSearch::signed_violation() const {
  return at_.value - at_.value.cwiseMax(problem_.row_lower()).cwiseMin(problem_.row_upper());
}

double SqpSearch::merit(double objective, const VectorView& value) const {
  const VectorXd violation = problem_.row_violations(value);
  return merit_.scale * objective + merit_.penalty * violation.sum() +
         0.5 * merit_.squares * violation.squaredNorm();
}

// While constraints are violated, steps that hardly lessen the penalty are left to a higher one.
double SqpSearch::least_improvement() const {
  const double least = options_.improvement_tolerance * std::max(1.0, std::abs(merit()));
  const double part = merit_.scale > 0.0 ? kLeastOfPenalty : kLeastOfViolation;
  return is_feasible() ? least : std::max(least, part * (merit() - merit_.scale * at_.objective));
}

double SqpSearch::rounding() const {
  return 10.0 * kEpsilon *
         std::max(
             {1.0, std::abs(merit()),
              merit_.penalty * (at_.value.size() == 0 ? 0.0 : at_.value.cwiseAbs().maxCoeff())});
}

double SqpSearch::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

bool SqpSearch::out_of_budget() const {
  return iterations_ >= options_.max_iterations || seconds() > options_.deadline;
}

}  // namespace thing_kin
