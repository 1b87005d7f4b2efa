#include "problem.hpp"
#include "thing_kin/kinematics/acceleration.hpp"
#include "thing_kin/kinematics/jacobian_dot.hpp"

namespace {

using bench::Problem;
using namespace thing_kin;

constexpr auto kAxes = ReferenceFrame::kWorldAligned;

auto fk(const Problem::Input& input) {
  const Chain& robot = bench::problem().robot;
  return forward_kinematics(robot, input.q.data(), robot.tool());
}

const Jacobian& jacobian(const Problem::Input& input) {
  static Posture posture;
  static Jacobian J;
  const Chain& robot = bench::problem().robot;
  place_joints(robot, input.q.data(), posture);
  geometric_jacobian(robot, posture, robot.tool(), kAxes, J);
  return J;
}

const Jacobian& jacobian_dot(const Problem::Input& input) {
  static Posture posture;
  static Jacobian dJ;
  const Chain& robot = bench::problem().robot;
  place_joints(robot, input.q.data(), posture);
  geometric_jacobian_dot(robot, posture, robot.tool(), kAxes, input.qd.data(), dJ);
  return dJ;
}

Vector6 drift(const Problem::Input& input) {
  static Posture posture;
  const Chain& robot = bench::problem().robot;
  place_joints(robot, input.q.data(), posture);
  return frame_drift(robot, posture, robot.tool(), kAxes, input.qd.data());
}

[[maybe_unused]] const bool entered = [] {
  const auto pose = [](const SE3& T) { return T.matrix(); };
  for (const bench::Level level : bench::levels()) {
    const std::string name = bench::name_of(level);
    bench::enter("fk", name, fk, pose, level);
    bench::enter("fk_and_jacobian", name, jacobian, bench::as_it_is, level);
  }
  bench::enter("jacobian_dot", "thing_kin", jacobian_dot, bench::as_it_is);
  bench::enter("drift", "thing_kin", drift, bench::as_it_is);
  return true;
}();

}  // namespace
