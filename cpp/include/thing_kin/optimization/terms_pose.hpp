#pragma once

#include <string>

#include "thing_kin/lie/se3.hpp"
#include "thing_kin/optimization/term_recipe.hpp"

namespace thing_kin::terms {

/// [p_goal - p; log(R_goal R^T)] of a frame, axes of the world, as pose_error(): [M17]
/// (4.26)-(4.28) with the signs put right. Where the rotation is half a turn off, its logarithm
/// jumps: the derivatives are those of the branch it takes.
class Pose : public TermRecipe {
 public:
  /// An empty name: the tool. Throws InvalidArgument unless the target is rigid and finite.
  explicit Pose(const SE3& target, std::string frame = "");

  std::string name() const override { return "pose"; }
  std::shared_ptr<const Term> bind(const std::shared_ptr<const Chain>& robot) const override;

  const SE3& target() const { return target_; }
  const std::string& frame() const { return frame_; }

 private:
  SE3 target_;
  std::string frame_;
};

/// p_goal - p of a point fixed to a frame, axes of the world.
class Position : public TermRecipe {
 public:
  explicit Position(const Eigen::Vector3d& target, std::string frame = "",
                    const Eigen::Vector3d& point = Eigen::Vector3d::Zero());

  std::string name() const override { return "position"; }
  std::shared_ptr<const Term> bind(const std::shared_ptr<const Chain>& robot) const override;

  const Eigen::Vector3d& target() const { return target_; }
  const std::string& frame() const { return frame_; }
  const Eigen::Vector3d& point() const { return point_; }

 private:
  Eigen::Vector3d target_;
  std::string frame_;
  Eigen::Vector3d point_;
};

/// log(R_goal R^T) of a frame, axes of the world.
class Orientation : public TermRecipe {
 public:
  explicit Orientation(const Eigen::Matrix3d& target, std::string frame = "");

  std::string name() const override { return "orientation"; }
  std::shared_ptr<const Term> bind(const std::shared_ptr<const Chain>& robot) const override;

  const Eigen::Matrix3d& target() const { return target_; }
  const std::string& frame() const { return frame_; }

 private:
  Eigen::Matrix3d target_;
  std::string frame_;
};

}  // namespace thing_kin::terms
