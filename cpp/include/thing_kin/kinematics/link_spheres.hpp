#pragma once

#include <vector>

#include "thing_kin/kinematics/jacobian.hpp"

namespace thing_kin {

/// A ball fixed to a frame of a chain.
struct LinkSphere {
  MovingPoint center;  ///< frame and coordinates in it, m
  double radius;       ///< m
};

/// The shape of a robot as balls, and which of them must not meet.
struct LinkSpheres {
  std::vector<LinkSphere> spheres;
  std::vector<std::pair<int, int>> pairs;  ///< of spheres whose distance counts as self-collision
};

}  // namespace thing_kin
