#include "thing_kin/optimization/terms_orientation_cone.hpp"

#include "bindings.hpp"
#include "optimization/term_recipe.hpp"

namespace thing_kin::python {

void bind_terms_orientation_cone(py::module_& m) {
  TermClass<terms::OrientationCone>(
      m, "OrientationCone", R"(The angle between an axis of a frame and a direction, rad, 0 to pi.

For problem.at_most(tk.terms.OrientationCone(...), angle): a glass held upright, a camera that
looks down. The angle has tips at 0 and pi, where no derivative exists: at 0 zeros are given, at pi
a derivative that leads away. So ask for at most some angle; where the axis must meet the direction
exactly, ask for an Orientation.

Parameters
----------
axis : (3,)
    In the frame, of any length but zero.
direction : (3,)
    In the world.
frame : str, optional
    Default: the tool.

Raises
------
ValueError
    If axis or direction is zero or not finite.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> term = tk.terms.OrientationCone(axis=(0, 0, 1), direction=(0, 0, -1))
>>> term.evaluate(tk.robots.ur5(), np.zeros(6))[0].round(4)
array([1.5708])
)")
      .def(py::init([](const ArrayLike& axis, const ArrayLike& direction, const FrameName& frame) {
             return terms::OrientationCone(read_vector<3>(axis, "axis"),
                                           read_vector<3>(direction, "direction"),
                                           frame.value_or(""));
           }),
           py::arg("axis"), py::arg("direction"), py::kw_only(), py::arg("frame") = py::none())
      .def_property_readonly(
          "axis", [](const terms::OrientationCone& term) { return frozen(term.axis()); },
          "In the frame, of unit length.")
      .def_property_readonly(
          "direction", [](const terms::OrientationCone& term) { return frozen(term.direction()); },
          "In the world, of unit length.")
      .def_property_readonly(
          "frame", [](const terms::OrientationCone& term) { return frame_or_none(term.frame()); },
          "None: the tool.")
      .def("__repr__", [](const terms::OrientationCone& term) {
        return py::str("OrientationCone(axis={}, direction={}, frame={!r})")
            .format(numbers_of(term.axis()), numbers_of(term.direction()),
                    frame_or_none(term.frame()));
      });
}

}  // namespace thing_kin::python
