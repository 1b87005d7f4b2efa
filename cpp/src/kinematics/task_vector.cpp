#include "thing_kin/kinematics/task_vector.hpp"

#include "thing_kin/core/error.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin {

Orientation orientation_from_string(const std::string& name) {
  if (name == "quaternion") {
    return Orientation::kQuaternion;
  }
  if (name == "rpy") {
    return Orientation::kRpy;
  }
  throw InvalidArgument("orientation", quoted(name), "'quaternion' or 'rpy'");
}

Eigen::Vector3d base_pose(const Chain& chain, const double* q) noexcept {
  const auto& [x, y, theta] = *chain.base_joints();
  return {q[x], q[y], q[theta]};
}

TaskVector task_vector(const Chain& chain, const double* q, Orientation orientation) noexcept {
  const SE3 T = forward_kinematics(chain, q, chain.tool());
  TaskVector s(6 + size_of(orientation));
  if (orientation == Orientation::kQuaternion) {
    s << T.translation, quaternion_from_rotation(T.rotation), base_pose(chain, q);
  } else {
    s << T.translation, rpy_from_rotation(T.rotation), base_pose(chain, q);
  }
  return s;
}

}  // namespace thing_kin
