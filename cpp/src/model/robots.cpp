#include "thing_kin/model/robots.hpp"

#include <numbers>
#include <utility>

#include "thing_kin/lie/so3.hpp"

namespace thing_kin::robots {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

// Universal Robots, UR5/UR10 CB3 user manuals 3.13, as in Universal_Robots_ROS2_Description,
// config/ur5 and ur10/joint_limits.yaml: +-360 deg; UR5 180 deg/s, UR10 120 deg/s for base and
// shoulder. The description halves the elbow's range for the sake of one planner; the arm does not.
// The maker states no joint acceleration; 5 rad/s^2 is what its driver's ur_moveit_config uses.
JointLimits ur_joint(double velocity_degrees) {
  return {-2 * kPi, 2 * kPi, velocity_degrees * kDegree, 5.0};
}

struct UrGeometry {
  double d1, a2, a3, d4, d5, d6;
  double slow_joint_velocity;  // deg/s, base and shoulder
};

constexpr UrGeometry kUr5{0.089159, -0.425, -0.39225, 0.10915, 0.09465, 0.0823, 180.0};
constexpr UrGeometry kUr10{0.1273, -0.612, -0.5723, 0.163941, 0.1157, 0.0922, 120.0};

std::vector<DhRow> ur_rows(const UrGeometry& g) {
  const JointLimits slow = ur_joint(g.slow_joint_velocity);
  const JointLimits fast = ur_joint(180.0);
  constexpr auto kRevolute = JointType::kRevolute;
  return {{g.d1, 0, 0, kPi / 2, kRevolute, slow, "q0", "shoulder"},
          {0, 0, g.a2, 0, kRevolute, slow, "q1", "upper_arm"},
          {0, 0, g.a3, 0, kRevolute, fast, "q2", "forearm"},
          {g.d4, 0, 0, kPi / 2, kRevolute, fast, "q3", "wrist_1"},
          {g.d5, 0, 0, -kPi / 2, kRevolute, fast, "q4", "wrist_2"},
          {g.d6, 0, 0, 0, kRevolute, fast, "q5", "tool"}};
}

// The Denavit-Hartenberg frame before joint k is offset by the row's d from where the joint's own
// frame, which the calibration gives, would be.
Chain calibrated(const UrGeometry& geometry, const UrCalibration& calibration, std::string name) {
  check(calibration);
  const std::vector<DhRow> rows = ur_rows(geometry);
  const auto origin = [&](std::size_t i) {
    const UrCalibration::Origin& of_joint = calibration.origins[i];
    return SE3{rotation_from_rpy(of_joint.rpy), of_joint.xyz};
  };
  const auto along_z = [&](double d) { return dh_transform(d, 0, 0, 0); };
  ChainDescription description;
  description.name = std::move(name);
  description.order = {0, 1, 2, 3, 4, 5};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Segment segment = to_segment(rows[i]);
    segment.before = i == 0 ? origin(0) : along_z(rows[i].d);
    segment.after = i + 1 < rows.size() ? origin(i + 1) * along_z(-rows[i + 1].d) : SE3{};
    description.segments.push_back(std::move(segment));
  }
  return Chain(std::move(description));
}

}  // namespace

Chain ur5(const UrCalibration& calibration) { return calibrated(kUr5, calibration, "ur5"); }

Chain ur10(const UrCalibration& calibration) { return calibrated(kUr10, calibration, "ur10"); }

Chain ur5() { return Chain::from_dh(ur_rows(kUr5), "ur5"); }

Chain ur10() { return Chain::from_dh(ur_rows(kUr10), "ur10"); }

// Clearpath, ridgeback_control/config/control.yaml (the 1.1 m/s also in the user manual). The
// range of x, y and theta is ours: a base has none.
BaseLimits ridgeback_limits() {
  BaseLimits limits = default_base_limits();
  for (const std::size_t i : {0U, 1U}) {
    limits[i].velocity = 1.1;
    limits[i].acceleration = 2.5;
  }
  limits[2].velocity = 2.0;
  limits[2].acceleration = 1.0;
  return limits;
}

// ARIA, params/pioneer-lx.p: TransVelMax 1800 mm/s, TransAccel 500 mm/s^2, RotVelMax 180 deg/s,
// RotAccel 150 deg/s^2. y stands for the sideways motion of the virtual base and takes x's rates:
// that, like the range of x, y and theta, is ours.
BaseLimits pioneer_lx_limits() {
  BaseLimits limits = default_base_limits();
  for (const std::size_t i : {0U, 1U}) {
    limits[i].velocity = 1.8;
    limits[i].acceleration = 0.5;
  }
  limits[2].velocity = 180.0 * kDegree;
  limits[2].acceleration = 150.0 * kDegree;
  return limits;
}

Chain thing(JointOrder order, const BaseLimits& base_limits) {
  // Rows 5 and 6 of [M17] Table A.1 mount the arm on the base.
  const SE3 mount = dh_transform(0.653, 0.0, 0.27, 0.0) * dh_transform(0.0, kPi / 2, 0.01, 0.0);
  return on_omni_base(ur10(), mount, base_limits, order, "thing");
}

SE3 default_pioneer_lx_mount() {
  SE3 mount;
  mount.translation << 0.075, 0.0, 0.448;
  return mount;
}

Chain pioneer_lx_ur5(const SE3& mount, JointOrder order, const BaseLimits& base_limits) {
  return on_omni_base(ur5(), mount, base_limits, order, "pioneer_lx_ur5");
}

}  // namespace thing_kin::robots
