#include "thing_kin/inverse/limits.hpp"

#include <pybind11/operators.h>

#include "bindings.hpp"

namespace thing_kin::python {

void bind_limits(py::module_& m) {
  py::class_<WheelLimits>(m, "WheelLimits",
                          R"(Speed limit of a mecanum base's wheels, for TaskPriority with limits.

The wheels' speeds are the inverse of [M17] (3.20): (v_x - v_y - k omega)/R front left,
(v_x + v_y - k omega)/R rear left, (v_x - v_y + k omega)/R rear right and (v_x + v_y + k omega)/R
front right, v and omega the base's velocity in its own axes.

Parameters
----------
radius : float, m
    R, of a wheel.
k : float, m
    Half the wheel base plus half the track.
speed : float, rad/s
    The fastest that a wheel may turn, either way.

Raises
------
ValueError
    If one of them is not positive or not finite.

Examples
--------
>>> import thing_kin as tk
>>> tk.WheelLimits(radius=0.1, k=0.5, speed=10.0)
WheelLimits(radius=0.1, k=0.5, speed=10.0)
)")
      .def(py::init<double, double, double>(), py::arg("radius"), py::arg("k"), py::arg("speed"))
      .def_readonly("radius", &WheelLimits::radius, "R of a wheel, m.")
      .def_readonly("k", &WheelLimits::k, "Half the wheel base plus half the track, m.")
      .def_readonly("speed", &WheelLimits::speed, "The largest speed, rad/s.")
      .def(py::self == py::self)
      .def("__hash__",
           [](const WheelLimits& w) { return py::hash(py::make_tuple(w.radius, w.k, w.speed)); })
      .def("__repr__", [](const WheelLimits& w) {
        return py::str("WheelLimits(radius={}, k={}, speed={})").format(w.radius, w.k, w.speed);
      });
}

}  // namespace thing_kin::python
