#pragma once

#include <string>
#include <vector>

#include "thing_kin/optimization/solve_status.hpp"
#include "thing_kin/planning/path_problem.hpp"

namespace thing_kin {

/// How a path is found.
enum class PathMethod : std::uint8_t {
  kSqp,           ///< the whole path at once, with obstacles, limits, base discs and headings
  kTaskPriority,  ///< pose by pose, hand first, base second, [M17] (4.18)
};

PathMethod path_method_from_string(const std::string& name);
const char* to_string(PathMethod method);

struct PathOptions {
  PathMethod method = PathMethod::kSqp;
  double position_tolerance = 1e-6;    ///< m, of the poses
  double rotation_tolerance = 1e-6;    ///< rad
  double constraint_tolerance = 1e-6;  ///< m and rad: a larger violation is no success
  int max_iterations = 200;

  /// Throws InvalidArgument.
  void check() const;
};

/// What became of a path. q is always finite; where there is no success, it is the best found.
struct PathPlan {
  std::vector<JointVector> q;
  std::vector<double> position_error;  ///< m, by forward kinematics
  std::vector<double> rotation_error;  ///< rad
  std::vector<double> dexterity;       ///< sqrt(kappa/M), [M17] (4.33), of the problem's columns
  SolveStatus status = SolveStatus::kBudget;
  bool success = false;           ///< by a check of its own, whatever the solver says
  int failed_waypoint = -1;       ///< the first where something is missed by too much
  std::string failed_constraint;  ///< and what: "pose", "max_joint_step of 'q1'"
  std::string message;
  double objective = 0.0;
  double constraint_violation = 0.0;  ///< largest, m or rad
  int iterations = 0;
  double time = 0.0;  ///< s
};

/// Configurations for the goals' waypoints in their order: minimizes
///
///     sum_k |W (q_{k+1} - q_k)|^2 / 2 + w sum_k log sqrt(kappa/M)(q_k)
///
/// over joint weights W and dexterity weight w, with every goal's pose met, the base within
/// base_radius of the base path, theta within the heading windows, clearances at least 0 at the
/// waypoints and on the straight lines in joint space between them, joints within their limits and
/// no joint's step beyond max_joint_step. A local minimum.
///
/// q_0 = seed where that solves the first pose; else q_0 is near the nearest solution, and the way
/// from the seed to it counts like a step. warm_start: a configuration for each goal, or empty.
PathPlan plan_path(const PathProblem& problem, const std::vector<PathGoal>& goals,
                   const JointVector& seed, const std::vector<JointVector>& warm_start,
                   const PathOptions& options);

/// sum_k |W (q_{k+1} - q_k)|^2 / 2 + w sum_k log sqrt(kappa/M)(q_k), and the way from `seed` unless
/// q_0 is the seed.
double path_objective(const PathProblem& problem, const std::vector<JointVector>& q,
                      const JointVector& seed);

}  // namespace thing_kin
