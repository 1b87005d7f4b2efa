#pragma once

#include <array>

#include "thing_kin/lie/se3.hpp"
#include "thing_kin/model/chain.hpp"

namespace thing_kin::closed_form {

/// What the arm's joints shall do for a frame of the chain.
struct Goal {
  const Chain& chain;
  int frame;
  SE3 target;
  std::array<int, 6> joints;  ///< those that may move, as indices in q
};

/// How far a configuration is from the goal.
struct PoseDistance {
  double position = 0.0;  ///< m
  double rotation = 0.0;  ///< rad

  bool within(double tolerance) const noexcept {
    return position <= tolerance && rotation <= tolerance;
  }
  double squared() const noexcept { return position * position + rotation * rotation; }
};

/// From a pose as 16 row-major numbers.
PoseDistance distance(const double* pose, const SE3& target) noexcept;

/// Moves the joints to where the distance is least nearby, by Levenberg and Marquardt's steps with
/// the exact Jacobian: a step or two where the goal is all but reached, and what it takes where it
/// can't be. Position in m and rotation in rad count alike.
PoseDistance polish(const Goal& goal, double* q) noexcept;

}  // namespace thing_kin::closed_form
