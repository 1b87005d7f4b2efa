#include "thing_kin/inverse/differential_inverse.hpp"

#include <pybind11/operators.h>

#include "bindings.hpp"

namespace thing_kin::python {

void bind_differential_inverse(py::module_& m) {
  py::class_<Exact>(m, "Exact", R"(Moore-Penrose inverse, [M17] (4.6), (4.9), for TaskPriority.

Exact, and unbounded near singularities.

Examples
--------
>>> import thing_kin as tk
>>> tk.Exact()
Exact()
)")
      .def(py::init<>())
      .def(py::self == py::self)
      .def("__hash__", [](const Exact&) { return py::hash(py::str("Exact")); })
      .def("__repr__", [](const Exact&) { return "Exact()"; });
  py::class_<Damped>(m, "Damped",
                     R"(Damped inverse J^T (J J^T + lambda I)^-1, [M17] (4.7), for TaskPriority.

Parameters
----------
damping : float, >= 0
    lambda itself, not its square.

Examples
--------
>>> import thing_kin as tk
>>> tk.Damped(1e-3).damping
0.001
)")
      .def(py::init<double>(), py::arg("damping"))
      .def_readonly("damping", &Damped::damping, "lambda.")
      .def(py::self == py::self)
      .def("__hash__", [](const Damped& d) { return py::hash(py::float_(d.damping)); })
      .def("__repr__", [](const Damped& d) { return py::str("Damped({})").format(d.damping); });
  py::class_<SelectivelyDamped>(m, "SelectivelyDamped",
                                R"(Selectively damped inverse, [M17] (4.11), for TaskPriority.

Buss & Kim (2005): each singular direction is damped by how far it would move the joints.

Parameters
----------
gamma_max : float, rad (m for prismatic joints)
    Largest absolute entry of a task's step; default pi/4.

Examples
--------
>>> import thing_kin as tk
>>> tk.SelectivelyDamped(gamma_max=0.5).gamma_max
0.5
)")
      .def(py::init<double>(), py::arg("gamma_max") = SelectivelyDamped().gamma_max)
      .def_readonly("gamma_max", &SelectivelyDamped::gamma_max, "Largest absolute entry of a step.")
      .def(py::self == py::self)
      .def("__hash__", [](const SelectivelyDamped& s) { return py::hash(py::float_(s.gamma_max)); })
      .def("__repr__", [](const SelectivelyDamped& s) {
        return py::str("SelectivelyDamped(gamma_max={})").format(s.gamma_max);
      });
}

}  // namespace thing_kin::python
