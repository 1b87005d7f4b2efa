#pragma once

#include "thing_kin/planning/path_plan.hpp"

namespace thing_kin {

/// Pose by pose by task priority, [M17] (4.18), each iterated until the hand is there and the base
/// rests, within the joints' limits. Gives q and iterations only; waypoints from the first on that
/// is not reached are copies of the last that was.
void follow_by_priority(const PathProblem& problem, const std::vector<PathGoal>& goals,
                        const JointVector& first, const PathOptions& options, PathPlan& plan);

}  // namespace thing_kin
