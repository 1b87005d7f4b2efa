#pragma once

#include <string>

#include "thing_kin/optimization/term_recipe.hpp"

namespace thing_kin::terms {

/// The angle between an axis of a frame and a direction in the world, rad, [0, pi]. It has tips at
/// 0 and pi, where no derivative exists: at 0 zero is given, which the angle of no neighbor
/// contradicts; at pi one that leads away.
class OrientationCone : public TermRecipe {
 public:
  /// Both of any length but zero, else InvalidArgument. An empty frame: the tool.
  OrientationCone(const Eigen::Vector3d& axis, const Eigen::Vector3d& direction,
                  std::string frame = "");

  std::string name() const override { return "orientation_cone"; }
  std::shared_ptr<const Term> bind(const std::shared_ptr<const Chain>& robot) const override;

  /// Of unit length.
  const Eigen::Vector3d& axis() const { return axis_; }
  const Eigen::Vector3d& direction() const { return direction_; }
  const std::string& frame() const { return frame_; }

 private:
  Eigen::Vector3d axis_;
  Eigen::Vector3d direction_;
  std::string frame_;
};

}  // namespace thing_kin::terms
