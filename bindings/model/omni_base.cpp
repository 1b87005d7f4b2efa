#include "model/omni_base.hpp"

#include <pybind11/stl.h>

#include "array.hpp"
#include "bindings.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

BaseLimits with_ranges(BaseLimits limits, const Ranges& ranges) {
  if (!ranges) {
    return limits;
  }
  if (ranges->size() != 3) {
    throw InvalidArgument("base_limits", std::to_string(ranges->size()) + " ranges",
                          "three pairs (lower, upper), of x, y and theta");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    std::tie(limits[i].lower, limits[i].upper) = (*ranges)[i];
    if (!(limits[i].lower <= limits[i].upper)) {
      throw InvalidArgument("base_limits",
                            "(" + text(limits[i].lower) + ", " + text(limits[i].upper) + ")",
                            "lower <= upper");
    }
  }
  return limits;
}

namespace {

void set_rates(BaseLimits& limits, const std::optional<std::array<double, 3>>& rates,
               double JointLimits::*member) {
  for (std::size_t i = 0; rates && i < 3; ++i) {
    limits[i].*member = (*rates)[i];
  }
}

}  // namespace

void bind_omni_base(py::module_& m) {
  m.def(
      "on_omni_base",
      [](const Chain& arm, const py::object& mount, const Ranges& base_limits,
         const std::string& order, const std::optional<std::array<double, 3>>& velocity,
         const std::optional<std::array<double, 3>>& acceleration, const std::string& name) {
        SE3 T_base_arm;
        if (!mount.is_none()) {
          T_base_arm = read_pose(read(mount, "mount", {4, 4}, false).data, "mount");
        }
        BaseLimits limits = with_ranges(default_base_limits(), base_limits);
        set_rates(limits, velocity, &JointLimits::velocity);
        set_rates(limits, acceleration, &JointLimits::acceleration);
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
