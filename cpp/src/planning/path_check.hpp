#pragma once

#include <string>
#include <vector>

#include "thing_kin/planning/path_problem.hpp"

namespace thing_kin {

/// A constraint that a path misses.
struct PathMiss {
  int waypoint = -1;    ///< or the first of the segment's two
  double amount = 0.0;  ///< m or rad
  std::string constraint;
};

/// A point of a segment where a clearance is below zero.
struct SegmentContact {
  int segment;
  int clearance;
  double t;
  double value;
};

/// What is asked of one pose error.
struct PoseTolerance {
  double position;  ///< m
  double rotation;  ///< rad
};

/// The worst of each waypoint and the segment behind it, in order, where it is beyond tolerance;
/// nothing of how the path was found is used. `largest`: the largest violation but of poses.
std::vector<PathMiss> check_path(const PathProblem& problem, const std::vector<PathGoal>& goals,
                                 const std::vector<JointVector>& q, PoseTolerance poses,
                                 double tolerance, double& largest);

/// The points of all segments where a clearance is less than -tolerance, found with a bound on its
/// curvature that leaves no gap: where none is found there is none.
std::vector<SegmentContact> find_contacts(const PathProblem& problem,
                                          const std::vector<JointVector>& q, double tolerance);

}  // namespace thing_kin
