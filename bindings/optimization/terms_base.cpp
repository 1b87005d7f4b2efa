#include "thing_kin/optimization/terms_base.hpp"

#include "bindings.hpp"
#include "optimization/term_recipe.hpp"

namespace thing_kin::python {

void bind_terms_base(py::module_& m) {
  TermClass<terms::BaseDistance>(m, "BaseDistance",
                                 R"(How far the base is from a point of the plane, m, [M17] (4.29).

At most a radius around a goal, at least one around an obstacle. Of the base's reference point, the
origin of its frame. At the center itself, where no derivative exists, that along x is given, so
that there is a way out.

Parameters
----------
center : (2,), m

Raises
------
ValueError
    If the shape is wrong or a number not finite; bound to a robot without a base.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.terms.BaseDistance((0.6, 0.8)).evaluate(tk.robots.thing(), np.zeros(9))[0]
array([1.])
)")
      .def(py::init([](const ArrayLike& center) {
             return terms::BaseDistance(read_vector<2>(center, "center"));
           }),
           py::arg("center"))
      .def_property_readonly(
          "center", [](const terms::BaseDistance& term) { return frozen(term.center()); },
          "(x, y), m.")
      .def("__repr__", [](const terms::BaseDistance& term) {
        return py::str("BaseDistance({})").format(numbers_of(term.center()));
      });
  TermClass<terms::BasePosition>(m, "BasePosition",
                                 R"(Where the base should be: target - (x, y), m; zero there.

Parameters
----------
target : (2,), m

Raises
------
ValueError
    If the shape is wrong or a number not finite; bound to a robot without a base.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.terms.BasePosition((0.6, 0.8)).evaluate(tk.robots.thing(), np.zeros(9))[0]
array([0.6, 0.8])
)")
      .def(py::init([](const ArrayLike& target) {
             return terms::BasePosition(read_vector<2>(target, "target"));
           }),
           py::arg("target"))
      .def_property_readonly(
          "target", [](const terms::BasePosition& term) { return frozen(term.target()); },
          "(x, y), m.")
      .def("__repr__", [](const terms::BasePosition& term) {
        return py::str("BasePosition({})").format(numbers_of(term.target()));
      });
}

}  // namespace thing_kin::python
