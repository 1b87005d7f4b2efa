#include "thing_kin/kinematics/task_vector.hpp"

#include "thing_kin/lie/so3.hpp"

namespace thing_kin {

Eigen::Vector3d base_pose(const Chain& chain, const double* q) noexcept {
  const auto& [x, y, theta] = *chain.base_joints();
  return {q[x], q[y], q[theta]};
}

TaskVector task_vector(const Chain& chain, const double* q) noexcept {
  const SE3 T = forward_kinematics(chain, q, chain.tool());
  TaskVector s;
  s << T.translation, quaternion_from_rotation(T.rotation), base_pose(chain, q);
  return s;
}

}  // namespace thing_kin
