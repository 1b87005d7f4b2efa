#include "pose_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "thing_kin/kinematics/pose_error.hpp"

namespace thing_kin {

namespace {

// Starts nearer than this in each joint, rad or m, lead to the same optimum as a rule.
constexpr double kApart = 0.7;

JointVector clamped(const JointBox& box, const double* seed, Eigen::Index n) {
  JointVector q = Eigen::Map<const Eigen::VectorXd>(seed, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    q[j] = box.inside(j, q[j]);
  }
  return q;
}

}  // namespace

PoseSearch::PoseSearch(const PosePlanner& planner, const SE3& target, const double* seed)
    : planner_(planner),
      target_(target),
      seed_(clamped(planner.box_, seed, planner.chain_.dof())),
      descent_(planner, target),
      starts_(planner, descent_.ik(), target_, seed_),
      start_(std::chrono::steady_clock::now()) {
  best_.q = seed_;
}

// True: the descent converged to a feasible point.
bool PoseSearch::try_from(const JointVector& q) {
  if (!descent_.begin(q)) {
    return false;
  }
  const int before = descent_.iterations();
  const double best = rank_.kind == Kind::kOptimum ? rank_.value : kInfinity;
  const bool converged = descent_.descend(planner_.options_.max_iterations, best);
  out_of_iterations_ |= descent_.iterations() - before == planner_.options_.max_iterations;
  const PosePoint& point = descent_.point();
  const bool feasible = descent_.is_feasible();
  const Rank rank{converged  ? Kind::kOptimum
                  : feasible ? Kind::kFeasible
                             : Kind::kInfeasible,
                  feasible ? point.objective.value : point.violation};
  if (rank < rank_) {
    rank_ = rank;
    best_.q = point.q;
    best_.objective = std::exp(point.objective.value);
  }
  return converged;
}

void PoseSearch::search_near() {
  if (try_from(seed_)) {
    return;
  }
  Starts starts;
  for (int i = 0; i < planner_.options_.max_restarts && !starts_.exhausted(); ++i) {
    const int count = starts_.next(starts);
    for (int branch = 0; branch < count; ++branch) {  // nearest to the seed first
      ++best_.restarts;
      if (try_from(starts[static_cast<std::size_t>(branch)])) {
        return;
      }
    }
  }
}

std::vector<PoseSearch::Candidate> PoseSearch::sample() {
  std::vector<Candidate> candidates;
  Starts starts;
  for (int i = 0; i < planner_.options_.samples && !starts_.exhausted(); ++i) {
    const int count = starts_.next(starts);
    for (int branch = 0; branch < count; ++branch) {
      const JointVector& q = starts[static_cast<std::size_t>(branch)];
      candidates.push_back({descent_.rank(q), samples_.size()});
      samples_.insert(samples_.end(), q.data(), q.data() + q.size());
    }
  }
  std::ranges::sort(candidates);
  return candidates;
}

// Single linkage, as in Rinnooy Kan and Timmer (1987): not from where a descent has begun or ended.
bool PoseSearch::is_apart(const JointVector& q) const {
  return std::ranges::none_of(visited_, [&](const JointVector& other) {
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      double way = q[j] - other[j];
      if (planner_.box_.is_endless(j)) {
        way = std::remainder(way, 2.0 * std::numbers::pi);
      }
      if (std::abs(way) > kApart) {
        return false;
      }
    }
    return true;
  });
}

void PoseSearch::search_all() {
  if (try_from(seed_)) {
    visited_.push_back(descent_.point().q);
  }
  const std::vector<Candidate> candidates = sample();
  for (const Candidate& candidate : candidates) {
    if (best_.restarts >= planner_.options_.descents && rank_.kind == Kind::kOptimum) {
      break;
    }
    const JointVector q =
        Eigen::Map<const Eigen::VectorXd>(&samples_[candidate.first], seed_.size());
    if (rank_.kind != Kind::kOptimum || is_apart(q)) {
      ++best_.restarts;
      visited_.push_back(q);
      if (try_from(q)) {
        visited_.push_back(descent_.point().q);
      }
    }
  }
}

// Success is what forward kinematics, the box and the clearances say of q, not the descent's word.
void PoseSearch::verify(PosePlan& plan) const {
  const Vector6 error =
      pose_error(forward_kinematics(planner_.chain_, plan.q.data(), planner_.frame_), target_);
  plan.position_error = error.head<3>().norm();
  plan.rotation_error = error.tail<3>().norm();
  plan.constraint_violation = -1.0;
  for (int i = 0; i < planner_.constraints(); ++i) {
    const double violation =
        planner_.violation(i, plan.q, plan.position_error, plan.rotation_error);
    if (violation > plan.constraint_violation) {
      plan.constraint_violation = violation;
      plan.worst = i;
    }
  }
  const bool feasible = plan.constraint_violation <= planner_.options_.tolerance;
  if (feasible) {
    plan.status = rank_.kind == Kind::kOptimum ? SolveStatus::kConverged : SolveStatus::kBudget;
  } else {
    plan.status = out_of_iterations_ ? SolveStatus::kBudget : SolveStatus::kInfeasible;
  }
}

PosePlan PoseSearch::run() {
  if (planner_.options_.global) {
    search_all();
  } else {
    search_near();
  }
  if (rank_.kind == Kind::kNone) {
    best_.q = descent_.nearest_miss().size() > 0 ? descent_.nearest_miss() : best_.q;
    best_.objective = planner_.objective(best_.q);
  }
  planner_.box_.wind_towards(seed_, best_.q);
  best_.iterations = descent_.iterations();
  verify(best_);
  best_.time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return best_;
}

}  // namespace thing_kin
