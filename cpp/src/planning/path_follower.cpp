#include "thing_kin/planning/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "path_solver.hpp"
#include "path_start.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/pose_error.hpp"

namespace thing_kin {

struct PathFollower::State {
  State(PathProblem asked, int size, const JointVector& q)
      : problem(std::move(asked)), window(size), solver(problem, size + 1), waiting(problem.dof()) {
    solver.set_goals({});
    PathGoal here;
    here.pose = forward_kinematics(problem.chain(), q.data(), problem.frame());
    if (problem.chain().base_joints()) {
      const auto& base = *problem.chain().base_joints();
      here.base << q[base[0]], q[base[1]], q[base[2]];
    }
    solver.append(here, q.data());
    solver.hold_first(true);
    const double heaviest = problem.joint_weights.cwiseAbs2().maxCoeff();
    penalty = 10.0 * (heaviest / size + problem.dexterity_weight);
    solver.set_penalty(penalty);
  }

  // Where the base is to be for a new waypoint: as far from its path as the last one is, and out of
  // the discs.
  Eigen::Vector2d place_for(const PathGoal& goal) const noexcept {
    const int last = solver.count() - 1;
    const auto& base = *problem.chain().base_joints();
    const Eigen::Vector2d at(solver.q(last)[base[0]], solver.q(last)[base[1]]);
    Eigen::Vector2d place =
        goal.base.head<2>() + at - solver.goals()[static_cast<std::size_t>(last)].base.head<2>();
    for (const Obstacle& obstacle : problem.obstacles()) {
      const Disc* disc = std::get_if<Disc>(&obstacle);
      if (disc == nullptr) {
        continue;
      }
      const Eigen::Vector2d out = place - disc->center;
      const double distance = out.norm();
      if (distance < disc->radius && distance > 0.0) {
        place = disc->center + disc->radius / distance * out;
      }
    }
    return place;
  }

  PathProblem problem;
  int window;
  PathSolver solver;
  JointVector waiting;
  double penalty;
};

PathFollower::PathFollower(PathProblem problem, int window, const JointVector& q) {
  if (window < 1) {
    throw InvalidArgument("window", std::to_string(window), "at least 1 waypoint");
  }
  if (q.size() != problem.dof() || !q.allFinite()) {
    throw InvalidArgument("seed", std::to_string(q.size()).append(" numbers"),
                          "a finite one for each joint");
  }
  state_ = std::make_unique<State>(std::move(problem), window, q);
}

PathFollower::~PathFollower() = default;
PathFollower::PathFollower(PathFollower&&) noexcept = default;
PathFollower& PathFollower::operator=(PathFollower&&) noexcept = default;

int PathFollower::window() const { return state_->window; }
int PathFollower::pending() const { return state_->solver.count() - 1; }
const PathProblem& PathFollower::problem() const { return state_->problem; }

bool PathFollower::push(const PathGoal& goal) noexcept {
  State& s = *state_;
  if (pending() >= s.window) {
    return false;
  }
  s.waiting = Eigen::Map<const Eigen::VectorXd>(s.solver.q(pending()), s.problem.dof());
  Eigen::Vector2d place;
  if (s.problem.has_base_path) {
    place = s.place_for(goal);
  }
  const auto* pull = s.problem.has_base_path ? &place : nullptr;
  if (!follow_pose(s.problem, goal, pull, s.waiting)) {
    return false;
  }
  s.solver.append(goal, s.waiting.data());
  return true;
}

bool PathFollower::step(FollowerStep& step) noexcept {
  State& s = *state_;
  if (pending() < 1) {
    return false;
  }
  s.solver.set_penalty(s.penalty);
  s.solver.begin();
  step.settled = s.solver.iterate() == PathSolver::Outcome::kConverged;
  step.q = Eigen::Map<const Eigen::VectorXd>(s.solver.q(1), s.problem.dof());
  const SE3 T = forward_kinematics(s.problem.chain(), step.q.data(), s.problem.frame());
  const SE3& goal = s.solver.goals()[1].pose;
  step.position_error = (goal.translation - T.translation).norm();
  step.rotation_error = rotation_angle(T.rotation, goal.rotation);
  step.violation = s.solver.violation_of_first();
  s.solver.drop_first();
  return true;
}

}  // namespace thing_kin
