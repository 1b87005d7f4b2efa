#pragma once

#include <memory>
#include <string>

#include "thing_kin/inverse/closed_form_ik.hpp"
#include "thing_kin/rmma/world_run.hpp"

namespace thing_kin {

/// A real arm above the artifact: its tool points down at a fixed height, its inverse kinematics
/// decides where it can be, and its joints' velocity and acceleration limits how long a motion
/// takes. Six joints with a closed form, on a base or fixed. Immutable.
class ManipulatorArm {
 public:
  /// `turn`: rad about the vertical, of the tool. Throws InvalidArgument("arm", ...) where the
  /// chain has no closed form.
  ManipulatorArm(std::shared_ptr<const Chain> chain, double height, double turn);

  /// The joints for a tool at `displacement` from the base, nearest to `q`, (dof); false if the arm
  /// can't be there.
  bool solve(const Eigen::Vector2d& displacement, JointVector& q) const noexcept;
  /// s, from rest to rest, each joint as quickly as its limits allow.
  double motion_time(const JointVector& from, const JointVector& to) const noexcept;

  const Chain& chain() const noexcept { return *chain_; }
  double height() const noexcept { return height_; }
  double turn() const noexcept { return turn_; }

 private:
  std::shared_ptr<const Chain> chain_;
  std::shared_ptr<const ClosedFormIk> ik_;
  double height_, turn_;
};

/// A world in which that arm does the work: overheads of its motions are the world's own, for a
/// motion of no length.
std::unique_ptr<WorldRun> with_arm(std::unique_ptr<WorldRun> run,
                                   std::shared_ptr<const ManipulatorArm> arm);

}  // namespace thing_kin
