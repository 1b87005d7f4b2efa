#include "thing_kin/kinematics/link_spheres.hpp"

#include <cmath>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

constexpr double kLargest = 1e50;  // squares of what is larger would overflow

std::string numbered(const char* argument, std::size_t i) {
  return std::string(argument).append("[").append(std::to_string(i)).append("]");
}

/// A frame that joint `joint` moves and no later one.
const Chain::Frame& frame_behind(const Chain& robot, int joint) {
  const auto frames = robot.frames();
  return *std::ranges::find_if(
      frames, [&](const Chain::Frame& frame) { return frame.joints == joint + 1; });
}

/// Balls from the frame of a joint to a point, both in what the joint moves; not at its end.
void append_link(const Chain& robot, int joint, const Eigen::Vector3d& to, double radius,
                 double spacing, std::vector<LinkSphere>& spheres) {
  const double length = to.norm();
  constexpr double kNothing = 1e-9;  // m: joints whose axes meet have no link between them
  if (length < kNothing) {
    return;
  }
  const Chain::Frame& frame = frame_behind(robot, joint);
  constexpr double kMost = 1e4;
  if (!(length / spacing <= kMost)) {
    throw InvalidArgument("spacing", text(spacing) + " on a link of " + text(length) + " m",
                          "at most 10000 spheres on a link");
  }
  const int count = static_cast<int>(std::ceil(length / spacing));
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d center = to * (static_cast<double>(i) / count);
    spheres.push_back({frame.name, frame.offset.inverse() * center, radius});
  }
}

}  // namespace

void check(const Chain& robot, const LinkSpheres& shape) {
  for (std::size_t i = 0; i < shape.spheres.size(); ++i) {
    const auto& [frame, center, radius] = shape.spheres[i];
    robot.frame_index(frame, numbered("spheres", i).append(".frame"));
    if (!(center.cwiseAbs().maxCoeff() <= kLargest)) {
      throw InvalidArgument(numbered("spheres", i).append(".center"), "numbers that are not finite",
                            "three finite numbers up to 1e50");
    }
    if (!(radius > 0.0 && radius <= kLargest)) {
      throw InvalidArgument(numbered("spheres", i).append(".radius"), text(radius), "a number > 0");
    }
  }
  const auto count = static_cast<int>(shape.spheres.size());
  for (std::size_t i = 0; i < shape.pairs.size(); ++i) {
    const auto& [one, other] = shape.pairs[i];
    if (one == other || std::min(one, other) < 0 || std::max(one, other) >= count) {
      throw InvalidArgument(numbered("pairs", i),
                            std::to_string(one).append(", ").append(std::to_string(other)),
                            "two different indices of " + std::to_string(count) + " spheres");
    }
  }
}

LinkSpheres spheres_along_links(const Chain& robot, double radius, double spacing) {
  if (!(radius > 0.0 && radius <= kLargest)) {
    throw InvalidArgument("radius", text(radius), "a number > 0");
  }
  constexpr double kLeast = 1e-3;  // m: finer than any use, and no array of millions
  if (!(spacing >= kLeast)) {
    throw InvalidArgument("spacing", text(spacing), "a number of at least 0.001");
  }
  const auto joints = robot.joints();
  LinkSpheres shape;
  for (int joint = robot.base_joints() ? 3 : 0; joint < robot.dof(); ++joint) {
    const auto next = static_cast<std::size_t>(joint) + 1;
    const SE3& end = next < joints.size() ? joints[next].fixed : robot.frames().back().offset;
    append_link(robot, joint, end.translation, radius, spacing, shape.spheres);
  }
  const Chain::Frame& tool = robot.frames().back();
  shape.spheres.push_back({tool.name, Eigen::Vector3d::Zero(), radius});
  return shape;
}

}  // namespace thing_kin
