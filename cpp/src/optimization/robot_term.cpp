#include "robot_term.hpp"

#include <cmath>

#include "thing_kin/core/error.hpp"

namespace thing_kin::terms {

RobotTerm::RobotTerm(std::shared_ptr<const Chain> robot) : robot_(std::move(robot)) {
  if (robot_ == nullptr) {
    throw InvalidArgument("robot", "none", "a robot, which this term is about");
  }
}

FrameTerm::FrameTerm(std::shared_ptr<const Chain> robot, const std::string& frame,
                     const Eigen::Vector3d& point)
    : RobotTerm(std::move(robot)),
      of_(frame.empty() ? this->robot().tool() : this->robot().frame_index(frame), point) {}

FrameTerm::Placed FrameTerm::place(const VectorView& q) const {
  Posture posture;
  place_joints(robot(), q.data(), posture);
  Placed placed;
  placed.frame = frame_pose(robot(), posture, of_.frame);
  placed.point = placed.frame * of_.point;
  geometric_jacobian(robot(), posture, of_, ReferenceFrame::kWorldAligned, placed.J);
  return placed;
}

void check_finite(const char* argument, const VectorView& numbers) {
  constexpr double kLargest = 1e50;
  for (const double number : numbers) {
    if (!(std::abs(number) <= kLargest)) {
      throw InvalidArgument(argument, text(number), "finite numbers up to 1e50");
    }
  }
}

}  // namespace thing_kin::terms
