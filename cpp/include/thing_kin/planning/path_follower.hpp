#pragma once

#include <memory>

#include "thing_kin/planning/path_problem.hpp"

namespace thing_kin {

class PathSolver;

/// What one step of a PathFollower gives.
struct FollowerStep {
  JointVector q;                ///< where to go next
  double position_error = 0.0;  ///< m, by forward kinematics
  double rotation_error = 0.0;  ///< rad
  double violation = 0.0;       ///< largest of its constraints and of the way there, m or rad
  bool settled = false;         ///< the window was at its optimum
};

/// The receding-horizon form of plan_path: poses come in one by one, a window of them is kept
/// optimized with one iteration a step, warm from the step before, and its first configuration goes
/// out. push() and step() allocate nothing.
///
/// One object serves one thread.
class PathFollower {
 public:
  /// Refers to the problem's chain. window: at least 1 waypoint. q: (n), where the robot stands.
  PathFollower(PathProblem problem, int window, const JointVector& q);
  ~PathFollower();
  PathFollower(const PathFollower&) = delete;
  PathFollower& operator=(const PathFollower&) = delete;
  PathFollower(PathFollower&&) noexcept;
  PathFollower& operator=(PathFollower&&) noexcept;

  /// A waypoint for the window's end. False, and nothing changes, if the window is full or the pose
  /// is not to be reached from the waypoint before it.
  bool push(const PathGoal& goal) noexcept;

  /// One iteration, then the window moves on: its first waypoint goes out, and is where the robot
  /// stands from now on. False if the window is empty.
  bool step(FollowerStep& step) noexcept;

  int window() const;
  int pending() const;
  const PathProblem& problem() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace thing_kin
