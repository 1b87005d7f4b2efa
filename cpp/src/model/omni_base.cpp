#include "thing_kin/model/omni_base.hpp"

#include <numbers>
#include <numeric>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

// order[i] is the place in q of joint i from the root, where the base's three come first.
std::vector<int> joint_order(int arm_joints, JointOrder order) {
  std::vector<int> indices(static_cast<std::size_t>(arm_joints) + 3);
  std::iota(indices.begin(), indices.end(), 0);
  if (order == JointOrder::kArmFirst) {
    std::iota(indices.begin(), indices.begin() + 3, arm_joints);
    std::iota(indices.begin() + 3, indices.end(), 0);
  }
  return indices;
}

}  // namespace

JointOrder joint_order_from_string(const std::string& name) {
  if (name == "arm_first") {
    return JointOrder::kArmFirst;
  }
  if (name == "base_first") {
    return JointOrder::kBaseFirst;
  }
  throw InvalidArgument("order", quoted(name), "'arm_first' or 'base_first'");
}

BaseLimits default_base_limits() {
  JointLimits position{-5.0, 5.0};
  return {position, position, JointLimits{-std::numbers::pi, std::numbers::pi}};
}

std::array<Segment, 4> omni_base_segments(const BaseLimits& limits) {
  constexpr double kRightAngle = std::numbers::pi / 2;
  const SE3 row = dh_transform(0.0, kRightAngle, 0.0, kRightAngle);
  return {Segment{"base_root", "", JointType::kFixed, SE3{}, row, {}},
          Segment{"base_x", "x", JointType::kPrismatic, SE3{}, row, limits[0]},
          Segment{"base_y", "y", JointType::kPrismatic, SE3{}, row, limits[1]},
          Segment{"base", "theta", JointType::kRevolute, SE3{}, SE3{}, limits[2]}};
}

Chain on_omni_base(const Chain& arm, const SE3& mount, const BaseLimits& limits, JointOrder order,
                   std::string name) {
  const ChainDescription& of_arm = arm.description();
  if (arm.base_joints()) {
    throw InvalidArgument("arm", quoted(arm.name()).append(", which has a base"),
                          "an arm without one");
  }
  ChainDescription description;
  description.name = name.empty() ? arm.name() + " on an omnidirectional base" : std::move(name);
  description.has_omni_base = true;
  for (const Segment& segment : omni_base_segments(limits)) {
    description.segments.push_back(segment);
  }
  const std::string mount_frame = of_arm.root == description.root ? "mount" : of_arm.root;
  description.segments.push_back({mount_frame, "", JointType::kFixed, SE3{}, mount, {}});
  description.segments.insert(description.segments.end(), of_arm.segments.begin(),
                              of_arm.segments.end());
  // The arm keeps its own order of joints inside the whole.
  description.order = joint_order(arm.dof(), order);
  const int first = order == JointOrder::kArmFirst ? 0 : 3;
  for (std::size_t i = 0; i < of_arm.order.size(); ++i) {
    description.order[i + 3] = first + of_arm.order[i];
  }
  return Chain(std::move(description));
}

}  // namespace thing_kin
