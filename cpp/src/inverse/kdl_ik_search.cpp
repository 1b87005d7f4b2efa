#include "kdl_ik_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "thing_kin/kinematics/posture.hpp"

namespace thing_kin {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Of one attempt: one that needs more has stalled.
constexpr int kMostIterations = 100;

// KDL weighs a rotation with 0.01.
constexpr double kRotationWeight = 0.01;

// The image of x by whole turns that is between the limits, or nearest to them.
double turned_back(double x, double lower, double upper) {
  if (x >= lower && x <= upper) {
    return x;
  }
  if (!std::isfinite(lower)) {
    return x - kTurn * std::ceil((x - upper) / kTurn);
  }
  const double above = x + kTurn * std::ceil((lower - x) / kTurn);
  const double below = above - kTurn;
  return above <= upper || above - upper <= lower - below ? above : below;
}

}  // namespace

KdlIkSearch::KdlIkSearch(KdlIk& solver, const SE3& target, const double* seed,
                         const KdlIkOptions& options)
    : solver_(solver),
      options_(options),
      residual_(target, {}, std::max(solver.reach_.length(), 1e-3)),
      samples_(solver.chain_.dof(), options.rng),
      home_(solver.chain_.dof()),
      has_seed_(seed != nullptr),
      begin_(std::chrono::steady_clock::now()) {
  const Eigen::Index n = solver.chain_.dof();
  lower_.resize(n);
  range_.resize(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const JointBox& box = solver.box_;
    // A turn of a joint without limits, one length of the arm either way of a slide.
    const double half = box.is_rotary(j) ? 0.5 * kTurn : std::max(solver.reach_.length(), 1.0);
    const bool bounded = std::isfinite(box.lower(j)) && std::isfinite(box.upper(j));
    lower_[j] = bounded ? box.lower(j) : box.inside(j, -half);
    range_[j] = (bounded ? box.upper(j) : std::max(box.inside(j, half), lower_[j])) - lower_[j];
    home_[j] = has_seed_ ? box.inside(j, seed[j]) : lower_[j] + 0.5 * range_[j];
  }
}

IkResult KdlIkSearch::run() {
  bool reached = attempt(has_seed_ ? home_ : sample());
  while (!reached && attempts_ <= options_.max_restarts && iterations_ < options_.max_iterations &&
         elapsed() < options_.deadline) {
    reached = attempt(sample());
  }
  return {best_,
          reached ? IkStatus::kSuccess : reason(),
          value_.position_error,
          value_.rotation_error,
          active_limits(solver_.chain_, best_),
          iterations_,
          attempts_ - 1,
          elapsed()};
}

JointVector KdlIkSearch::sample() noexcept {
  ++drawn_;
  JointVector q(range_.size());
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    const double x = lower_[j] + samples_(drawn_, static_cast<int>(j)) * range_[j];
    q[j] = std::min(x, solver_.box_.upper(j));
  }
  return q;
}

bool KdlIkSearch::attempt(const JointVector& start) {
  ++attempts_;
  const double tolerance =
      std::min(options_.position_tolerance, kRotationWeight * options_.rotation_tolerance);
  const int most = std::min(kMostIterations, options_.max_iterations - iterations_);
  KdlChain::Descent end = solver_.kdl_.descend(residual_.target(), start, tolerance, most);
  iterations_ += end.iterations;
  if (!end.q.allFinite()) {
    end.q = start;
  }
  const JointBox& box = solver_.box_;
  for (Eigen::Index j = 0; j < end.q.size(); ++j) {
    if (box.is_rotary(j)) {
      end.q[j] = turned_back(end.q[j], box.lower(j), box.upper(j));
    }
  }
  box.wind_towards(home_, end.q);
  PoseResidual::Value value;
  if (!box.contains(end.q)) {
    residual_.evaluate(forward_kinematics(solver_.chain_, end.q.data(), solver_.chain_.tool()),
                       value);
    beyond_limits_ = beyond_limits_ || is_reached(value);
    end.q = end.q.cwiseMax(solver_.chain_.lower()).cwiseMin(solver_.chain_.upper());
  }
  residual_.evaluate(forward_kinematics(solver_.chain_, end.q.data(), solver_.chain_.tool()),
                     value);
  const bool reached = is_reached(value);
  if (reached || value.cost() < least_) {
    best_ = end.q;
    value_ = value;
    least_ = value.cost();
  }
  return reached;
}

bool KdlIkSearch::is_reached(const PoseResidual::Value& value) const noexcept {
  return value.position_error <= options_.position_tolerance &&
         value.rotation_error <= options_.rotation_tolerance;
}

double KdlIkSearch::elapsed() const noexcept {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

// KDL proves nothing: only what is certain is called unreachable, and limits are blamed only where
// a solution beyond them was found.
IkStatus KdlIkSearch::reason() const noexcept {
  if (!(elapsed() < options_.deadline)) {
    return IkStatus::kDeadline;
  }
  if (solver_.reach_.beyond(solver_.box_, residual_.target().translation) > 0.0) {
    return IkStatus::kUnreachable;
  }
  const ActiveLimits active = active_limits(solver_.chain_, best_);
  const bool is_at_a_limit =
      std::ranges::any_of(active, [](std::int8_t side) { return side != 0; });
  return beyond_limits_ && is_at_a_limit ? IkStatus::kLimited : IkStatus::kBudget;
}

}  // namespace thing_kin
