#include "model/omni_base.hpp"

#include "array.hpp"
#include "bindings.hpp"
#include "model/chain.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

BaseLimits with_ranges(BaseLimits limits, const py::object& ranges) {
  if (ranges.is_none()) {
    return limits;
  }
  const Batch pairs = read(ranges, "base_limits", {3, 2}, false, Finite::kNo);
  for (std::size_t i = 0; i < 3; ++i) {
    limits[i].lower = pairs.data[2 * i];
    limits[i].upper = pairs.data[2 * i + 1];
    if (!(limits[i].lower <= limits[i].upper)) {
      throw InvalidArgument("base_limits",
                            "(" + text(limits[i].lower) + ", " + text(limits[i].upper) + ")",
                            "lower <= upper");
    }
  }
  return limits;
}

namespace {

void set_rates(BaseLimits& limits, const py::object& values, const char* name,
               double JointLimits::*member) {
  if (values.is_none()) {
    return;
  }
  const SmallVector rates = read_rates(values, name, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    limits[i].*member = rates[static_cast<Eigen::Index>(i)];
  }
}

}  // namespace

void bind_omni_base(py::module_& m) {
  m.def(
      "on_omni_base",
      [](const Chain& arm, const py::object& mount, const py::object& base_limits,
         const std::string& order, const py::object& velocity, const py::object& acceleration,
         const std::string& name) {
        SE3 T_base_arm;
        if (!mount.is_none()) {
          T_base_arm = read_pose(read(mount, "mount", {4, 4}, false).data, "mount");
        }
        BaseLimits limits = with_ranges(default_base_limits(), base_limits);
        set_rates(limits, velocity, "base_velocity_limits", &JointLimits::velocity);
        set_rates(limits, acceleration, "base_acceleration_limits", &JointLimits::acceleration);
        return on_omni_base(arm, T_base_arm, limits, joint_order_from_string(order), name);
      },
      py::arg("arm"), py::arg("mount") = py::none(), py::kw_only(),
      py::arg("base_limits") = py::none(), py::arg("order") = "arm_first",
      py::arg("base_velocity_limits") = py::none(),
      py::arg("base_acceleration_limits") = py::none(), py::arg("name") = "",
      R"(An arm on an omnidirectional base: three virtual joints x, y, theta, [M17] 3.2.

Parameters
----------
arm : Chain
    Without a base of its own.
mount : (4, 4), optional
    Pose of the arm's root in the base frame; default: the identity.
base_limits : three pairs (lower, upper), optional
    Of x (m), y (m), theta (rad); default +-5 m and +-pi.
order : 'arm_first' or 'base_first'
    q = [q0 ..., x, y, theta], [M17] (3.6), or [x, y, theta, q0 ...].
base_velocity_limits, base_acceleration_limits : three floats, optional
    Default: unlimited.
name : str

Raises
------
ValueError
    If the arm has a base, the mount is no rigid transform, or a name or limit is wrong.

Examples
--------
>>> import thing_kin as tk
>>> robot = tk.on_omni_base(tk.robots.ur5(), mount=tk.transform(xyz=(0.1, 0, 0.5)))
>>> robot.names
('q0', 'q1', 'q2', 'q3', 'q4', 'q5', 'x', 'y', 'theta')
)");
}

}  // namespace thing_kin::python
