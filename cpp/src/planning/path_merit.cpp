#include <algorithm>
#include <cmath>

#include "path_maps.hpp"
#include "path_solver.hpp"
#include "thing_kin/kinematics/log_dexterity.hpp"

namespace thing_kin {

using namespace path;

// (r^2 - |b - c|^2)/(2 r): smooth at the middle, and near the rim the distance from it.
double PathSolver::base_slack(int k, const double* at, double* gradient) const noexcept {
  const auto& base = *problem_.chain().base_joints();
  const PathGoal& goal = goals_[index(k)];
  const double r = problem_.base_radius - std::min(kMargin, 0.5 * problem_.base_radius);
  const double scale = std::max(r, kLeastBaseRadius);
  double square = 0.0;
  for (const std::size_t i : {0U, 1U}) {
    const double way = at[base[i]] - goal.base[static_cast<Eigen::Index>(i)];
    square += way * way;
    if (gradient != nullptr) {
      gradient[i] = -way / scale;
    }
  }
  return 0.5 * (r * r - square) / scale;
}

PathSolver::Merit PathSolver::begin() noexcept {
  merit_ = evaluate(q_.data());
  std::swap(values_, trial_values_);
  return merit_;
}

double PathSolver::violation_of_first() noexcept {
  Merit merit;
  evaluate_waypoint(0, q(0), merit);
  merit.worst = 0.0;
  evaluate_waypoint(1, q(1), merit);
  evaluate_segment(0, q(0), merit);
  return merit.worst;
}

PathSolver::Merit PathSolver::evaluate(const double* q) noexcept {
  Merit merit;
  for (int k = 0; k < count(); ++k) {
    evaluate_waypoint(k, q + k * n_, merit);
    if (k > 0) {
      evaluate_segment(k - 1, q + (k - 1) * n_, merit);
    }
  }
  if (has_origin_ && fixed_ == 0) {
    const JointVector way = ConstVector(q, n_) - origin_;
    merit.objective += 0.5 * square_weights_.dot(way.cwiseAbs2());
  }
  for (const Watched& watched : watched_) {
    const double* a = q + watched.k * n_;
    const JointVector at =
        (1.0 - watched.t) * ConstVector(a, n_) + watched.t * ConstVector(a + n_, n_);
    Posture posture;
    place_joints(problem_.chain(), at.data(), posture);
    const double d = problem_.clearances().value(posture, at.data(), watched.i) - kMargin;
    merit.violation += std::max(0.0, -d);
    merit.worst = std::max(merit.worst, -d);
  }
  return merit;
}

void PathSolver::evaluate_waypoint(int k, const double* q, Merit& merit) noexcept {
  const Chain& chain = problem_.chain();
  const PathGoal& goal = goals_[index(k)];
  Posture& posture = postures_[index(k)];
  place_joints(chain, q, posture);
  if (problem_.dexterity_weight > 0.0) {
    Jacobian J;
    geometric_jacobian(chain, posture, problem_.frame(), ReferenceFrame::kWorldAligned, J);
    const double value = log_dexterity(J, problem_.column_weights.data());
    merit.objective += problem_.dexterity_weight * std::min(value, kWorstDexterity);
  }
  const bool counts = k >= fixed_;
  const auto miss = [&](double slack) {
    if (counts) {
      merit.violation += std::max(0.0, -slack);
      merit.worst = std::max(merit.worst, -slack);
    }
  };
  for (int j = 0; j < n_; ++j) {
    miss(std::min(q[j] - chain.lower()[j], chain.upper()[j] - q[j]) - kMargin);
  }
  if (problem_.has_base_path && problem_.base_radius < kUnlimited) {
    miss(base_slack(k, q, nullptr));
  }
  if (chain.base_joints()) {
    const double theta = q[(*chain.base_joints())[2]];
    miss(std::min(theta - goal.heading_lower, goal.heading_upper - theta) - kMargin);
  }
  double* values = trial_values_.data() + k * clearances_;
  for (int i = 0; i < clearances_; ++i) {
    values[i] = problem_.clearances().value(posture, q, i);
    miss(values[i] - kMargin);
  }
}

void PathSolver::evaluate_segment(int k, const double* q, Merit& merit) noexcept {
  const JointVector step = ConstVector(q + n_, n_) - ConstVector(q, n_);
  merit.objective += 0.5 * square_weights_.dot(step.cwiseAbs2());
  for (int j = 0; j < n_; ++j) {
    const double slack = step_bound(j) - std::abs(step[j]);
    merit.violation += std::max(0.0, -slack);
    merit.worst = std::max(merit.worst, -slack);
  }
  const double* from = trial_values_.data() + k * clearances_;
  for (int i = 0; i < clearances_; ++i) {
    const Inner inner = inner_minimum(k, q, i, from[i], from[clearances_ + i]);
    if (inner.t > 0.0) {
      const double slack = inner.value - kMargin;
      merit.violation += std::max(0.0, -slack);
      merit.worst = std::max(merit.worst, -slack);
    }
  }
}

// Where a clearance is least within a segment, if that is between its ends: safeguarded secant on
// its slope.
PathSolver::Inner PathSolver::inner_minimum(int k, const double* from, int i, double d_from,
                                            double d_to) const noexcept {
  const double* to = from + n_;
  const JointVector dq = ConstVector(to, n_) - ConstVector(from, n_);
  Inner best;
  if (d_from + d_to > problem_.motion_bound(i, from, dq.data()) + 4.0 * kMargin) {
    return best;  // it stays above zero
  }
  JointVector gradient;
  JointVector at(n_);
  double value = 0.0;
  const auto slope_at = [&](const Posture& posture, const double* where) {
    value = problem_.clearances().gradient(posture, where, i, gradient);
    return gradient.dot(dq);
  };
  const auto slope = [&](double t) {
    Posture posture;
    at = ConstVector(from, n_) + t * dq;
    place_joints(problem_.chain(), at.data(), posture);
    return slope_at(posture, at.data());
  };
  double low = 0.0;
  double high = 1.0;
  double slope_low = slope_at(postures_[index(k)], from);
  if (slope_low >= 0.0) {
    return best;
  }
  double slope_high = slope_at(postures_[index(k + 1)], to);
  if (slope_high <= 0.0) {
    return best;
  }
  constexpr int kProbes = 12;
  const double small = 1e-7 * (slope_high - slope_low);
  for (int probe = 0; probe < kProbes; ++probe) {
    double t = low - slope_low * (high - low) / (slope_high - slope_low);
    const double edge = 0.05 * (high - low);
    t = std::clamp(t, low + edge, high - edge);
    const double s = slope(t);
    best.t = t;
    best.value = value;
    if (std::abs(s) < small) {
      break;
    }
    (s < 0.0 ? low : high) = t;
    (s < 0.0 ? slope_low : slope_high) = s;
  }
  return best;
}

}  // namespace thing_kin
