#include "pose_starts.hpp"

#include <cmath>
#include <numbers>

namespace thing_kin {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Draws for one base placement until it is out of all discs.
constexpr int kMostDraws = 32;

}  // namespace

PoseStarts::PoseStarts(const PosePlanner& planner, const IkProblem& ik, const SE3& target,
                       const JointVector& seed)
    : planner_(planner),
      ik_(ik),
      target_(target),
      seed_(seed),
      samples_(ik, planner.sequence_, planner.reach_) {}

// Even over the disc about the goal, or over all places from where the arm may reach the target.
void PoseStarts::draw_base(double* base) noexcept {
  const PosePlanOptions& options = planner_.options_;
  const auto& joints = *planner_.chain_.base_joints();
  const bool has_goal = options.base_goal.has_value();
  const double radius = has_goal ? options.base_radius : planner_.reach_.radius();
  const Eigen::Vector2d center =
      has_goal ? *options.base_goal : Eigen::Vector2d(target_.translation.head<2>());
  double low = ik_.box.lower(joints[2]);
  double high = ik_.box.upper(joints[2]);
  if (high - low > kTurn) {
    low = std::clamp(seed_[joints[2]] - std::numbers::pi, low, high - kTurn);
    high = low + kTurn;
  }
  for (int i = 0; i < kMostDraws; ++i) {
    ++drawn_;
    const double r = radius * std::sqrt(planner_.sequence_(drawn_, 0));
    const double angle = kTurn * planner_.sequence_(drawn_, 1);
    base[0] = center.x() + r * std::cos(angle);
    base[1] = center.y() + r * std::sin(angle);
    base[2] = low + planner_.sequence_(drawn_, 2) * (high - low);
    base[0] = std::clamp(base[0], ik_.box.lower(joints[0]), ik_.box.upper(joints[0]));
    base[1] = std::clamp(base[1], ik_.box.lower(joints[1]), ik_.box.upper(joints[1]));
    if (planner_.is_base_clear({base[0], base[1]})) {
      return;
    }
  }
}

int PoseStarts::by_closed_form(std::array<JointVector, ClosedFormSolutions::kMost>& starts) {
  std::array<double, 3> base{};
  if (planner_.chain_.base_joints()) {
    draw_base(base.data());
  } else {
    exhausted_ = true;
  }
  ClosedFormSolutions solutions;
  planner_.closed_form_->solve(target_, base.data(), solutions,
                               {.seed = seed_.data(), .closest = false});
  int count = 0;
  for (const ClosedFormSolution& solution : solutions) {
    if (solution.exact && ik_.box.contains(solution.q)) {
      starts[static_cast<std::size_t>(count++)] = solution.q;
    }
  }
  return count;
}

int PoseStarts::by_descent(JointVector& start) {
  IkPoint hand;
  samples_.next(hand.q);
  if (planner_.options_.base_goal) {
    const auto& joints = *planner_.chain_.base_joints();
    std::array<double, 3> base{};
    draw_base(base.data());
    for (std::size_t i = 0; i < 3; ++i) {
      hand.q[joints[i]] = base[i];
    }
  }
  int iterations = 0;
  if (!descend(ik_, kMostArrivals, hand, iterations)) {
    return 0;
  }
  ik_.box.wind_towards(seed_, hand.q);
  start = hand.q;
  return 1;
}

int PoseStarts::next(std::array<JointVector, ClosedFormSolutions::kMost>& starts) {
  const int count = planner_.closed_form_ ? by_closed_form(starts) : 0;
  if (count > 0 || exhausted_) {
    return count;
  }
  return by_descent(starts[0]);
}

}  // namespace thing_kin
