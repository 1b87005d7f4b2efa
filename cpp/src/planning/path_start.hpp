#pragma once

#include <vector>

#include "thing_kin/planning/path_problem.hpp"

namespace thing_kin {

/// Where the base should go, m, waypoint by waypoint; empty: anywhere.
using BaseLine = std::vector<Eigen::Vector2d>;

/// Ways past the Discs, the shortest detour first: for each disc that the line runs through, past
/// its left or its right.
std::vector<BaseLine> lines_past_discs(const PathProblem& problem, const BaseLine& line);

/// Moves q onto a pose, and in what that leaves free the base to its place and into its heading
/// window, if the place is not null; limits and obstacles left out. False if the hand does not get
/// there.
bool follow_pose(const PathProblem& problem, const PathGoal& goal, const Eigen::Vector2d* place,
                 JointVector& q) noexcept;

/// Configurations that follow the poses one from another, hand first, base second, limits and
/// obstacles left out: where the optimization begins. Waypoints from the first on that is not
/// reached are copies of the last that was; returns that waypoint, or -1.
int follow_poses(const PathProblem& problem, const std::vector<PathGoal>& goals,
                 const JointVector& first, const BaseLine& line, std::vector<JointVector>& q);

}  // namespace thing_kin
