#include "ik_search.hpp"

#include <algorithm>
#include <limits>

#include "ik_objective.hpp"

namespace thing_kin {

namespace {

using Clock = std::chrono::steady_clock;

// An attempt that gets this far without a stall converges slowly, towards a singular posture.
constexpr int kMostIterations = 40;

// Where the target is certainly out of reach, more would only search for a closer pose; where it is
// not, fewer do not show that it is.
constexpr int kHopelessAttempts = 16;

// For the closest pose of a target out of reach.
constexpr int kMostPolishing = 200;

// Of the arm's length: how near a base drives before the arm is asked.
constexpr double kComfortableReach = 0.5;

// Attempts when the nearest solution is wanted: half of them around the seed, nearest first, half
// from anywhere.
constexpr int kAttemptsAround = 32;

JointVector inside(const JointBox& box, const double* seed, Eigen::Index n) {
  JointVector q(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    q[j] = box.inside(j, seed[j]);
  }
  return q;
}

JointBox box_around(JointBox box, const JointVector& seed, const JointVector& max_step) {
  if (max_step.size() > 0 && seed.size() > 0) {
    box.keep_near(seed, max_step);
  }
  return box;
}

}  // namespace

void NearMisses::add(const IkPoint& point) noexcept {
  const auto behind = [&](const IkPoint& other) { return point.value.cost() < other.value.cost(); };
  const auto place = std::find_if(points_.begin(), points_.begin() + count_, behind);
  if (place == points_.end()) {
    return;
  }
  count_ = std::min(count_ + 1, points_.size());
  std::move_backward(place, points_.begin() + count_ - 1, points_.begin() + count_);
  *place = point;
}

IkSearch::IkSearch(const NumericIk& solver, const SE3& target, const double* seed) noexcept
    : solver_(solver),
      options_(solver.options_),
      has_seed_(seed != nullptr),
      seed_(has_seed_ ? inside(solver.box_, seed, solver.chain_.dof()) : JointVector()),
      problem_{solver.chain_,
               solver.frame_,
               PoseResidual(target, options_.weights, solver.length_),
               box_around(solver.box_, seed_, options_.max_step),
               solver.mobility_,
               options_.position_tolerance,
               options_.rotation_tolerance},
      samples_(problem_, solver.samples_, solver.reach_),
      begin_(Clock::now()) {}

IkResult IkSearch::run() noexcept {
  is_hopeless_ = is_out_of_reach();
  const bool closed = solver_.closed_form_.has_value() && !is_hopeless_;
  bool reached = false;
  if (options_.nearest && closed) {
    reached = ask_closed_form() || (has_more() && attempt(seed_));
  } else {
    reached = (has_seed_ && attempt(seed_)) || (closed && has_more() && ask_closed_form());
  }
  while (!reached && has_more() && !(is_hopeless_ && attempts_ >= kHopelessAttempts)) {
    reached = restart();
  }
  return reached ? found() : failed();
}

bool IkSearch::is_out_of_reach() const noexcept {
  return problem_.residual.has_all_of_position() &&
         solver_.reach_.beyond(problem_.box, problem_.residual.target().translation) > 0.0;
}

bool IkSearch::has_more() const noexcept {
  return attempts_ <= options_.max_restarts && iterations_ < options_.max_iterations &&
         elapsed() < options_.deadline;
}

// Its solutions come nearest to the seed first; where there is none, they are the closest poses.
bool IkSearch::ask_closed_form() noexcept {
  ++attempts_;
  ClosedFormSolutions solutions;
  const JointVector& weights = options_.joint_weights;
  solver_.closed_form_->solve(problem_.residual.target(), nullptr, solutions,
                              {.seed = has_seed_ ? seed_.data() : nullptr,
                               .weights = weights.size() > 0 ? weights.data() : nullptr});
  for (const ClosedFormSolution& solution : solutions) {
    IkPoint point{solution.q, {}};
    const int most = std::min(kMostIterations, options_.max_iterations - iterations_);
    if (most <= 0 || !problem_.box.contains(solution.q)) {
      continue;
    }
    if (descend(problem_, most, point, iterations_)) {
      best_ = point;
      is_nearest_ = solution.exact;
      return true;
    }
    misses_.add(point);
  }
  is_hopeless_ = solutions.status != ClosedFormStatus::kSolved;
  return false;
}

bool IkSearch::attempt(const JointVector& start) noexcept {
  ++attempts_;
  IkPoint point{start, {}};
  if (problem_.residual.has_position() && solver_.reach_.has_slides()) {
    const SE3 T = forward_kinematics(problem_.chain, start.data(), problem_.frame);
    Eigen::Vector3d way = problem_.residual.way_from(T.translation);
    solver_.reach_.drive(problem_.box, kComfortableReach * solver_.reach_.length(), way,
                         point.q.data());
  }
  const int most = std::min(kMostIterations, options_.max_iterations - iterations_);
  if (descend(problem_, most, point, iterations_)) {
    best_ = point;
    return true;
  }
  misses_.add(point);
  return false;
}

bool IkSearch::restart() noexcept {
  JointVector start;
  samples_.next(start);
  return attempt(start);
}

double IkSearch::elapsed() const noexcept {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

double IkSearch::distance_from_seed(const JointVector& q) const noexcept {
  return (q - seed_).cwiseAbs2().cwiseQuotient(problem_.mobility).sum();
}

// Moves point to its image nearest to the seed, unless that is so many turns away that their
// rounding shows.
void IkSearch::wind(IkPoint& point) const noexcept {
  IkPoint image = point;
  problem_.box.wind_towards(seed_, image.q);
  if (image.q == point.q) {
    return;
  }
  problem_.residual.evaluate(forward_kinematics(problem_.chain, image.q.data(), problem_.frame),
                             image.value);
  constexpr double kRounding = 1.0 + 1e-9;
  if (problem_.is_reached(point.value) ? problem_.is_reached(image.value)
                                       : image.value.cost() <= kRounding * point.value.cost()) {
    point = image;
  }
}

// Among the images and the null-space motions of a solution, the one that is wanted.
void IkSearch::settle(IkPoint& point) noexcept {
  if (has_seed_) {
    wind(point);
  }
  const IkObjective objective = options_.nearest ? IkObjective::kSeed : options_.objective;
  if (objective != IkObjective::kNone) {
    improve(problem_, IkMeasure(problem_, objective, seed_), point, iterations_);
  }
}

void IkSearch::search_nearer() noexcept {
  IkPoint nearest = best_;
  double distance = distance_from_seed(nearest.q);
  for (int i = 1; i <= kAttemptsAround && has_more(); ++i) {
    JointVector start;
    samples_.next(start);
    const double part = std::min(1.0, 2.0 * i / kAttemptsAround);
    start = seed_ + part * (start - seed_);
    if (!attempt(inside(problem_.box, start.data(), start.size()))) {  // but for rounding it is
      continue;
    }
    settle(best_);
    if (const double other = distance_from_seed(best_.q); other < distance) {
      nearest = best_;
      distance = other;
    }
  }
  best_ = nearest;
}

IkResult IkSearch::found() noexcept {
  settle(best_);
  if (options_.nearest && !is_nearest_) {
    search_nearer();
  }
  return result(IkStatus::kSuccess);
}

IkResult IkSearch::failed() noexcept {
  if (misses_.nearest().empty()) {  // no time for even one; or no closed form within the box
    best_.q = has_seed_ ? seed_ : samples_.middle();
    return result(reason({}));
  }
  const Rest rest = come_nearest();
  if (has_seed_) {
    wind(best_);
  }
  return result(reason(rest));
}

// The cost has many minima where it can't be zero: several attempts are brought to theirs.
Rest IkSearch::come_nearest() noexcept {
  Rest best;
  double least = std::numeric_limits<double>::infinity();
  for (IkPoint& point : misses_.nearest()) {
    const int most = elapsed() < options_.deadline ? kMostPolishing : 0;
    const Rest rest = find_closest_pose(problem_, most, point, iterations_);
    if (best_.q.size() == 0 || point.value.cost() < least) {
      least = point.value.cost();
      best_ = point;
      best = rest;
    }
  }
  return best;
}

IkStatus IkSearch::reason(const Rest& rest) const noexcept {
  if (!(elapsed() < options_.deadline)) {
    return IkStatus::kDeadline;
  }
  if (!rest.stationary) {
    return IkStatus::kBudget;
  }
  bool limited = false;
  for (Eigen::Index j = 0; j < best_.q.size(); ++j) {
    if (rest.held_back[static_cast<std::size_t>(j)]) {
      const double x = best_.q[j];
      if (x != problem_.chain.lower()[j] && x != problem_.chain.upper()[j]) {
        return IkStatus::kStepBound;
      }
      limited = true;
    }
  }
  if (limited) {
    return IkStatus::kLimited;
  }
  if (is_hopeless_) {
    return IkStatus::kUnreachable;
  }
  if (options_.max_step.size() > 0) {
    return IkStatus::kStepBound;
  }
  return attempts_ < kHopelessAttempts ? IkStatus::kBudget : IkStatus::kUnreachable;
}

// Whatever the solver thinks, the errors are those of forward kinematics at the q that is returned,
// and they decide.
IkResult IkSearch::result(IkStatus status) const noexcept {
  PoseResidual::Value value;
  problem_.residual.evaluate(forward_kinematics(problem_.chain, best_.q.data(), problem_.frame),
                             value);
  const bool reached = value.position_error <= options_.position_tolerance &&
                       value.rotation_error <= options_.rotation_tolerance;
  if (reached != (status == IkStatus::kSuccess)) {
    status = reached ? IkStatus::kSuccess : IkStatus::kBudget;
  }
  return {best_.q,
          status,
          value.position_error,
          value.rotation_error,
          active_limits(problem_.chain, best_.q),
          iterations_,
          std::max(0, attempts_ - 1),
          elapsed()};
}

}  // namespace thing_kin
