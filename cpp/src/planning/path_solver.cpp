#include "path_solver.hpp"

#include <algorithm>
#include <cmath>

#include "path_maps.hpp"
#include "thing_kin/kinematics/damped_inverse.hpp"
#include "thing_kin/kinematics/pose_error.hpp"

namespace thing_kin {

using namespace path;

namespace {

constexpr double kOnPose = 1e-11;  // m and rad: a waypoint is on its pose
constexpr int kRetractions = 12;
constexpr double kLeastRadius = 0.02, kMostRadius = 1.0;
constexpr double kMostPenalty = 1e7;
constexpr double kStationary = 1e-9;  // relative decrease that is none
constexpr double kArmijo = 0.01;

}  // namespace

PathSolver::PathSolver(const PathProblem& problem, int capacity)
    : problem_(problem),
      n_(problem.dof()),
      m_(problem.freedom()),
      clearances_(problem.clearances().size()),
      square_weights_(problem.joint_weights.cwiseAbs2()),
      qp_(std::max(1, m_)) {
  const auto most = index(capacity);
  const auto n = index(n_);
  const auto m = index(m_);
  const auto c = index(clearances_);
  goals_.reserve(most);
  for (auto* v :
       {&q_, &trial_, &dq_, &gradient_, &dexterity_gradient_, &lagrangian_, &linear_multiplier_}) {
    v->assign(most * n, 0.0);
  }
  Z_.assign(most * n * m, 0.0);
  dexterity_hessian_.assign(most * n * n, 0.0);
  curvature_.assign(most * m * m, 0.0);
  J_.resize(most);
  postures_.resize(most);
  base_multiplier_.assign(most, 0.0);
  for (auto* v : {&values_, &trial_values_, &clearance_multiplier_, &inner_multiplier_}) {
    v->assign(most * c, 0.0);
  }
  const int rows = capacity * (4 * n_ + 8 + 2 * clearances_);
  refs_.reserve(index(rows));
  points_.reserve(index(capacity * clearances_));
  qp_.reserve(capacity, rows);
}

void PathSolver::set_goals(const std::vector<PathGoal>& goals) {
  goals_ = goals;
  forget();
}

void PathSolver::come_from(const double* from) {
  has_origin_ = from != nullptr;
  if (has_origin_) {
    origin_ = ConstVector(from, n_);
  }
}

void PathSolver::forget() noexcept {
  for (auto* v :
       {&linear_multiplier_, &base_multiplier_, &clearance_multiplier_, &inner_multiplier_}) {
    std::ranges::fill(*v, 0.0);
  }
  watched_.clear();
  damping_ = 0.0;
  radius_ = 0.5;
  last_decrease_ = 1.0;
}

void PathSolver::drop_first() noexcept {
  if (goals_.empty()) {
    return;
  }
  goals_.erase(goals_.begin());
  const auto shift = [](std::vector<double>& v, int stride) {
    std::copy(v.begin() + stride, v.end(), v.begin());
    std::fill(v.end() - stride, v.end(), 0.0);
  };
  shift(q_, n_);
  shift(linear_multiplier_, n_);
  shift(base_multiplier_, 1);
  shift(clearance_multiplier_, clearances_);
  shift(inner_multiplier_, clearances_);
}

void PathSolver::append(const PathGoal& goal, const double* from) noexcept {
  goals_.push_back(goal);  // within capacity
  std::copy_n(from, n_, q(count() - 1));
}

void PathSolver::watch(int k, int i, double t) { watched_.push_back({k, i, t, 0.0}); }

bool PathSolver::retract(const PathGoal& goal, double* q) const noexcept {
  const Chain& chain = problem_.chain();
  const JointVector mobility = JointVector::Ones(n_);
  const RowFactors identity;
  Posture posture;
  Jacobian J;
  JointVector step(n_);
  double last = kUnlimited;
  for (int i = 0; i < kRetractions; ++i) {
    place_joints(chain, q, posture);
    const Vector6 e = pose_error(frame_pose(chain, posture, problem_.frame()), goal.pose);
    const double norm = e.norm();
    if (norm < kOnPose) {
      return true;
    }
    if (!(norm < 4.0 * last)) {
      return false;
    }
    last = norm;
    geometric_jacobian(chain, posture, problem_.frame(), ReferenceFrame::kWorldAligned, J);
    damped_inverse(J, identity, mobility.data(), kGramDamping, e, step.data());
    const double longest = step.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(longest)) {
      return false;
    }
    Vector(q, n_) += std::min(1.0, 0.5 / longest) * step;
  }
  return last < 100.0 * kOnPose;
}

// Builds and solves the quadratic program; its decrease, or a negative number if it broke down.
double PathSolver::solve_model() noexcept {
  qp_.reset(count() - fixed_);
  add_rows();
  add_objective();
  add_curvature(false);
  if (!qp_.is_convex(damping_)) {
    add_objective();  // anew: what is added below is positive semidefinite
    add_curvature(true);
  }
  const double share = last_decrease_ / std::max(1.0, static_cast<double>(qp_.rows()));
  const double mu = std::clamp(share, 1e-9, 1e-2 * rho_);
  if (!qp_.solve(std::max(damping_, 1e-12), mu)) {
    return -1.0;
  }
  return qp_.decrease();
}

bool PathSolver::move_to_trial(double alpha) noexcept {
  for (int k = 0; k < count(); ++k) {
    Vector at(trial_.data() + k * n_, n_);
    at = ConstVector(q(k), n_) + alpha * ConstVector(dq_.data() + k * n_, n_);
    if (k >= fixed_ && !retract(goals_[index(k)], at.data())) {
      return false;
    }
  }
  return true;
}

// Backtracking on the exact l1 merit.
bool PathSolver::try_steps(double decrease, double longest) noexcept {
  const double before = merit_.objective + rho_ * merit_.violation;
  const double most = std::min(1.0, radius_ / std::max(longest, 1e-300));
  double alpha = most;
  constexpr int kTrials = 6;
  for (int i = 0; i < kTrials; ++i) {
    if (move_to_trial(alpha)) {
      const Merit merit = evaluate(trial_.data());
      const double after = merit.objective + rho_ * merit.violation;
      const double noise = 1e-15 * (1.0 + std::abs(before));
      if (after <= before - kArmijo * alpha * decrease + noise) {
        merit_ = merit;
        std::swap(q_, trial_);
        std::swap(values_, trial_values_);
        const double moved = alpha * longest;
        radius_ =
            alpha < most ? 1.5 * moved : std::max(std::min(radius_, 4.0 * moved), 2.0 * moved);
        radius_ = std::clamp(radius_, kLeastRadius, kMostRadius);
        damping_ = alpha == 1.0 ? (damping_ < 1e-6 ? 0.0 : 0.1 * damping_) : damping_;
        all_rows_ = alpha < most;
        return true;
      }
    }
    alpha *= 0.4;
  }
  damping_ = std::max(10.0 * damping_, 1e-4);
  all_rows_ = true;
  return false;
}

PathSolver::Outcome PathSolver::iterate() noexcept {
  if (m_ == 0 || count() <= fixed_) {
    return merit_.worst <= kFeasible ? Outcome::kConverged : Outcome::kStationary;
  }
  linearize();
  constexpr int kDampings = 8;
  for (int attempt = 0; attempt < kDampings; ++attempt) {
    const double decrease = solve_model();
    if (decrease < -1e-12) {
      damping_ = std::max(10.0 * damping_, 1e-4);
      continue;
    }
    double longest = 0.0;
    for (int k = fixed_; k < count(); ++k) {
      Vector dq(dq_.data() + k * n_, n_);
      dq.noalias() = ConstMatrix(basis(k), n_, m_).lazyProduct(ConstVector(qp_.p(stage(k)), m_));
      longest = std::max(longest, dq.lpNorm<Eigen::Infinity>());
    }
    const double scale = 1e-3 + std::abs(merit_.objective);
    const bool stationary = decrease < kStationary * scale;
    if (stationary && merit_.worst > kFeasible) {
      if (rho_ >= kMostPenalty) {
        return Outcome::kStationary;
      }
      rho_ *= 30.0;
      continue;
    }
    keep_multipliers();
    last_decrease_ = std::max(decrease, 0.0);
    if (stationary) {
      return Outcome::kConverged;
    }
    if (try_steps(decrease, longest)) {
      return Outcome::kStepped;
    }
  }
  return merit_.worst <= kFeasible ? Outcome::kConverged : Outcome::kStationary;
}

}  // namespace thing_kin
