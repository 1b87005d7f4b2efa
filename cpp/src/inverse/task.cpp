#include "thing_kin/inverse/task.hpp"

#include <cmath>

#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/kinematics/pose_error.hpp"
#include "thing_kin/lie/se2.hpp"
#include "thing_kin/lie/so3.hpp"
#include "thing_kin/model/joint_difference.hpp"

namespace thing_kin {

namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

}  // namespace

Task::Task(double gain, std::string frame) : gain_(gain), frame_(std::move(frame)) {
  constexpr double kLargest = 1e6;  // far beyond use, and no product with an error overflows
  if (!(gain > 0.0 && gain <= kLargest)) {
    throw InvalidArgument("gain", text(gain), "a number > 0, at most 1e6");
  }
}

void PoseTask::evaluate(const Chain& chain, const Posture& posture, int frame, const double* /*q*/,
                        const double* target, TaskValue& value) const noexcept {
  const Eigen::Map<const RowMajor4> goal(target);
  const SE3 T_goal{goal.topLeftCorner<3, 3>(), goal.topRightCorner<3, 1>()};
  value.jacobian = world_aligned_jacobian(chain, posture, frame);
  value.error = pose_error(frame_pose(chain, posture, frame), T_goal);
}

void PositionTask::evaluate(const Chain& chain, const Posture& posture, int frame,
                            const double* /*q*/, const double* target,
                            TaskValue& value) const noexcept {
  const Eigen::Map<const Eigen::Vector3d> goal(target);
  value.jacobian = world_aligned_jacobian(chain, posture, frame).topRows<3>();
  value.error = goal - frame_pose(chain, posture, frame).translation;
}

void OrientationTask::evaluate(const Chain& chain, const Posture& posture, int frame,
                               const double* /*q*/, const double* target,
                               TaskValue& value) const noexcept {
  const Eigen::Map<const RowMajor3> goal(target);
  const Eigen::Matrix3d R = frame_pose(chain, posture, frame).rotation;
  value.jacobian = world_aligned_jacobian(chain, posture, frame).bottomRows<3>();
  value.error = so3_log(goal * R.transpose());
}

void BaseTask::evaluate(const Chain& chain, const Posture& /*posture*/, int /*frame*/,
                        const double* q, const double* target, TaskValue& value) const noexcept {
  const auto& base = *chain.base_joints();
  value.jacobian.setZero(3, chain.dof());
  value.error.resize(3);
  for (int row = 0; row < 3; ++row) {
    const int joint = base[static_cast<std::size_t>(row)];
    value.jacobian(row, joint) = 1.0;
    value.error[row] = target[row] - q[joint];
  }
  value.error[2] = wrap_angle(value.error[2]);
}

void PostureTask::evaluate(const Chain& chain, const Posture& /*posture*/, int /*frame*/,
                           const double* q, const double* target, TaskValue& value) const noexcept {
  const int n = chain.dof();
  value.jacobian.setIdentity(n, n);
  value.error.resize(n);
  joint_difference(chain, q, target, value.error.data());
  if (chain.base_joints()) {
    double& theta = value.error[(*chain.base_joints())[2]];
    theta = wrap_angle(theta);
  }
}

}  // namespace thing_kin
