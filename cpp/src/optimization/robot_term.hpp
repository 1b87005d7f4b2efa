#pragma once

#include <memory>
#include <string>
#include <utility>

#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/optimization/term.hpp"

namespace thing_kin::terms {

/// A term of a robot's joints, which it keeps alive. Throws InvalidArgument if there is none.
class RobotTerm : public Term {
 public:
  explicit RobotTerm(std::shared_ptr<const Chain> robot);

  int variables() const override { return robot_->dof(); }

 protected:
  const Chain& robot() const { return *robot_; }

 private:
  std::shared_ptr<const Chain> robot_;
};

/// The same of a point fixed to a frame.
class FrameTerm : public RobotTerm {
 protected:
  /// Where the frame is, where the point is in the world, and the point's Jacobian.
  struct Placed {
    SE3 frame;
    Eigen::Vector3d point;
    Jacobian J;  ///< world-aligned
  };

  /// An empty name: the tool. Throws InvalidArgument("frame", ...) for an unknown one.
  FrameTerm(std::shared_ptr<const Chain> robot, const std::string& frame,
            const Eigen::Vector3d& point = Eigen::Vector3d::Zero());

  Placed place(const VectorView& q) const;

 private:
  MovingPoint of_;
};

/// Throws InvalidArgument unless all numbers are finite, and no larger than 1e50, lest their
/// squares overflow.
void check_finite(const char* argument, const VectorView& numbers);

}  // namespace thing_kin::terms
