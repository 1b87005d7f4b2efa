#include "thing_kin/model/dh.hpp"

#include <numbers>
#include <optional>

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

DhRow make_row(double d, double theta, double a, double alpha,
               const std::optional<std::string>& joint, std::string name, std::string frame,
               std::optional<double> lower, std::optional<double> upper,
               std::optional<double> velocity_limit, std::optional<double> acceleration_limit) {
  DhRow row{d, theta, a, alpha, JointType::kFixed, {}, std::move(name), std::move(frame)};
  row.joint = joint ? joint_type_from_string(*joint) : JointType::kFixed;
  if (row.joint == JointType::kFixed &&
      (lower || upper || velocity_limit || acceleration_limit || !row.name.empty())) {
    throw InvalidArgument("joint", "a fixed row with a joint's name or limits",
                          "joint='revolute', 'continuous' or 'prismatic' for these");
  }
  const double range = row.joint == JointType::kRevolute ? std::numbers::pi : kInfinity;
  row.limits = {lower.value_or(-range), upper.value_or(range), velocity_limit.value_or(kInfinity),
                acceleration_limit.value_or(kInfinity)};
  check(row);
  return row;
}

}  // namespace

void bind_dh(py::module_& m) {
  py::class_<DhRow>(m, "DH", R"(One standard (distal) Denavit-Hartenberg row, [M17] (3.7).

Rz(theta) Tz(d) Tx(a) Rx(alpha). A revolute joint's variable adds to theta, a prismatic one's to d.

Parameters
----------
d, a : float, m
theta, alpha : float, rad
joint : 'revolute', 'continuous', 'prismatic' or None
    Continuous: revolute without limits. None (or 'fixed'): a constant row, which has no joint
    variable.
name : str
    Of the joint; default q0, q1, ... along the chain.
frame : str
    Of the frame after the row; default frame1, frame2, ..., and tool for the last.
lower, upper : float, rad or m
    Default +-pi for a revolute joint, unlimited for a prismatic one; none for a continuous one.
velocity_limit, acceleration_limit : float > 0, rad/s, rad/s^2 (m/s, m/s^2)
    Default unlimited (inf).

Raises
------
ValueError
    If a number is not finite, limits are crossed or rates are not positive, or a continuous joint
    has a position limit.

Examples
--------
>>> import thing_kin as tk
>>> tk.DH(a=-0.425, joint="revolute").upper
3.141592653589793
)")
      .def(py::init(&make_row), py::arg("d") = 0.0, py::arg("theta") = 0.0, py::arg("a") = 0.0,
           py::arg("alpha") = 0.0, py::arg("joint") = py::none(), py::kw_only(),
           py::arg("name") = "", py::arg("frame") = "", py::arg("lower") = py::none(),
           py::arg("upper") = py::none(), py::arg("velocity_limit") = py::none(),
           py::arg("acceleration_limit") = py::none())
      .def_readonly("d", &DhRow::d, "Offset along z, m.")
      .def_readonly("theta", &DhRow::theta, "Angle about z, rad.")
      .def_readonly("a", &DhRow::a, "Length along x, m.")
      .def_readonly("alpha", &DhRow::alpha, "Twist about x, rad.")
      .def_property_readonly(
          "joint", [](const DhRow& row) { return to_string(row.joint); },
          "'revolute', 'continuous', 'prismatic' or 'fixed'.")
      .def_readonly("name", &DhRow::name, "Name of the joint; empty: numbered.")
      .def_readonly("frame", &DhRow::frame, "Name of the frame after the row; empty: numbered.")
      .def_property_readonly(
          "lower", [](const DhRow& row) { return row.limits.lower; }, "Lower limit, rad or m.")
      .def_property_readonly(
          "upper", [](const DhRow& row) { return row.limits.upper; }, "Upper limit, rad or m.")
      .def_property_readonly(
          "velocity_limit", [](const DhRow& row) { return row.limits.velocity; }, "rad/s or m/s.")
      .def_property_readonly(
          "acceleration_limit", [](const DhRow& row) { return row.limits.acceleration; },
          "rad/s^2 or m/s^2.")
      .def("__repr__", [](const DhRow& row) {
        return py::str("DH(d={}, theta={}, a={}, alpha={}, joint={!r})")
            .format(row.d, row.theta, row.a, row.alpha, to_string(row.joint));
      });
}

}  // namespace thing_kin::python
