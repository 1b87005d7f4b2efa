#pragma once

#include <bitset>

#include "thing_kin/inverse/ik_descent.hpp"

namespace thing_kin {

/// Where least squares has come to rest.
struct Rest {
  bool stationary = false;         ///< no small motion within the box comes nearer
  std::bitset<kMaxDof> held_back;  ///< joints at a side of the box that would have to leave it
};

/// Goes on from `point` to the nearest local minimum of the distance to a target out of reach:
/// Newton's method with the exact second derivatives, damped, on the joints that are not held
/// back. Iterations, at most `most`, are added to `iterations`.
Rest find_closest_pose(const IkProblem& problem, int most, IkPoint& point,
                       int& iterations) noexcept;

}  // namespace thing_kin
