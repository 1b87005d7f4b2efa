#pragma once

#include <string>
#include <vector>

#include "thing_kin/kinematics/clearance.hpp"
#include "thing_kin/optimization/term_recipe.hpp"

namespace thing_kin::terms {

/// What a robot of balls is clear of obstacles and of itself by, m: a number for each of
/// Clearances.
class Clearance : public TermRecipe {
 public:
  /// Without self_collision the pairs of the shape do not count. Throws InvalidArgument where an
  /// obstacle is none.
  Clearance(LinkSpheres spheres, std::vector<Obstacle> obstacles, bool self_collision = true);

  std::string name() const override { return "clearance"; }
  std::shared_ptr<const Term> bind(const std::shared_ptr<const Chain>& robot) const override;

  const LinkSpheres& spheres() const { return spheres_; }
  const std::vector<Obstacle>& obstacles() const { return obstacles_; }

 private:
  LinkSpheres spheres_;
  std::vector<Obstacle> obstacles_;
};

}  // namespace thing_kin::terms
