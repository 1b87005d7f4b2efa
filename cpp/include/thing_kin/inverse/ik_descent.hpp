#pragma once

#include "thing_kin/inverse/joint_box.hpp"
#include "thing_kin/inverse/pose_residual.hpp"

namespace thing_kin {

/// One target for one chain, as the parts of the numerical solver share it.
struct IkProblem {
  const Chain& chain;
  int frame;
  PoseResidual residual;
  JointBox box;
  JointVector mobility;  ///< inverse joint weights
  double position_tolerance;
  double rotation_tolerance;

  bool is_reached(const PoseResidual::Value& value) const noexcept {
    return value.position_error <= position_tolerance && value.rotation_error <= rotation_tolerance;
  }
};

/// A configuration and how far it is from the target.
struct IkPoint {
  JointVector q;
  PoseResidual::Value value;
};

/// Descends from point.q for at most `most` iterations, which are added to `iterations`, or until
/// the cost falls too slowly to be on the way to a solution. Returns whether the target is reached;
/// if not, `point` is the closest on the way.
bool descend(const IkProblem& problem, int most, IkPoint& point, int& iterations) noexcept;

/// The same; where the target is reached, `posture` is that of point.q.
bool descend(const IkProblem& problem, int most, IkPoint& point, int& iterations,
             Posture& posture) noexcept;

}  // namespace thing_kin
