#pragma once

#include <string>
#include <utility>
#include <vector>

#include "thing_kin/model/chain.hpp"

namespace thing_kin {

/// A ball fixed to a frame of a robot.
struct LinkSphere {
  std::string frame;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< coordinates in that frame, m
  double radius = 0.0;                               ///< m

  bool operator==(const LinkSphere&) const = default;
};

/// The shape of a robot as balls, and which of them must not meet.
struct LinkSpheres {
  std::vector<LinkSphere> spheres;
  std::vector<std::pair<int, int>> pairs;  ///< of spheres whose distance counts as self-collision

  bool operator==(const LinkSpheres&) const = default;
};

/// Throws InvalidArgument: a frame the robot does not have, a radius that is not positive, a pair
/// of what is no sphere or of one sphere twice, what is not finite.
void check(const Chain& robot, const LinkSpheres& shape);

/// Balls along the arm: on each link from its joint's frame straight to the next joint's, the last
/// to the tool, their centers at most `spacing` apart. What an omnidirectional base carries below
/// the arm's first joint is left out: Discs are for the base. Without pairs.
LinkSpheres spheres_along_links(const Chain& robot, double radius, double spacing);

/// The pairs that may meet and need not: all, but of
/// - one link or neighboring links (those with at most one joint between them);
/// - spheres that cannot meet, by the triangle inequality over the links between them;
/// - spheres that overlap in a quarter or more of 256 postures, spread evenly within the limits:
///   too near each other along the chain for balls to tell.
/// A joint without limits takes every angle, or every place within a meter.
std::vector<std::pair<int, int>> self_collision_pairs(const Chain& robot,
                                                      const std::vector<LinkSphere>& spheres);

}  // namespace thing_kin
