#include "thing_kin/kinematics/posture.hpp"

#include "kernels/kernels.hpp"

namespace thing_kin {

namespace {

SE3 from_columns(const double* columns) {
  using PaddedPose = Eigen::Map<const Eigen::Matrix<double, 4, 4>>;
  const PaddedPose padded(columns);
  return {padded.topLeftCorner<3, 3>(), padded.topRightCorner<3, 1>()};
}

}  // namespace

void place_joints(const Chain& chain, const double* q, Posture& posture) noexcept {
  kernels().place(chain.skeleton(), q, chain.dof(), posture.columns);
}

SE3 frame_pose(const Chain& chain, const Posture& posture, int frame) noexcept {
  const SkeletonFrame& f = chain.skeleton_frame(frame);
  const SE3 offset = from_columns(f.offset);
  return f.joints == 0 ? offset : from_columns(posture.columns + 16 * (f.joints - 1)) * offset;
}

SE3 forward_kinematics(const Chain& chain, const double* q, int frame) noexcept {
  alignas(64) double columns[16];
  kernels().pose(chain.skeleton(), chain.skeleton_frame(frame), q, columns);
  return from_columns(columns);
}

}  // namespace thing_kin
