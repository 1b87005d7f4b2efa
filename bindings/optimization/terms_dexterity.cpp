#include "thing_kin/optimization/terms_dexterity.hpp"

#include "bindings.hpp"
#include "optimization/term_recipe.hpp"

namespace thing_kin::python {

/// An argument `jacobian`: "whole_body", "arm" or an array of weights.
class ColumnsLike : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(ColumnsLike, object, [](PyObject*) { return 1; })
};

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::ColumnsLike> {
  static constexpr auto name = const_name("str | numpy.typing.ArrayLike");
};

}  // namespace pybind11::detail

namespace thing_kin::python {

namespace {

terms::Columns read_columns(const ColumnsLike& jacobian) {
  if (!py::isinstance<py::str>(jacobian)) {
    return read_any_vector(jacobian, "jacobian");
  }
  if (jacobian.equal(py::str("whole_body"))) {
    return terms::WholeBody{};
  }
  if (jacobian.equal(py::str("arm"))) {
    return terms::Arm{};
  }
  throw InvalidArgument("jacobian", std::string(py::repr(jacobian)),
                        "'whole_body', 'arm' or a weight for each joint");
}

py::object jacobian_of(const terms::DexterityMeasure& term) {
  if (const auto* weights = std::get_if<terms::ColumnWeights>(&term.columns())) {
    return numbers_of(*weights);
  }
  return py::str(std::holds_alternative<terms::Arm>(term.columns()) ? "arm" : "whole_body");
}

template <typename T>
void bind_measure(py::module_& m, const char* name, const char* doc) {
  TermClass<T>(m, name, doc)
      .def(py::init([](const ColumnsLike& jacobian, const FrameName& frame) {
             return T(read_columns(jacobian), frame.value_or(""));
           }),
           py::kw_only(), py::arg("jacobian") = "whole_body", py::arg("frame") = py::none())
      .def_property_readonly(
          "jacobian", [](const T& term) { return jacobian_of(term); },
          "'whole_body', 'arm' or the weights of the joints.")
      .def_property_readonly(
          "frame", [](const T& term) { return frame_or_none(term.frame()); }, "None: the tool.")
      .def("__repr__", [name = std::string(name)](const T& term) {
        return py::str("{}(jacobian={!r}, frame={!r})")
            .format(name, jacobian_of(term), frame_or_none(term.frame()));
      });
}

}  // namespace

void bind_terms_dexterity(py::module_& m) {
  bind_measure<terms::Manipulability>(m, "Manipulability",
                                      R"(Manipulability M = sqrt(det(J J^T)), [M17] (4.30).

For problem.at_least(tk.terms.Manipulability(), 0.05). Where the rank is lost it is 0, and so are
the derivatives given.

Parameters
----------
jacobian : 'whole_body', 'arm' or (n,)
    Whose columns count: all; all but the base's; or all, each times its joint's weight, 0 to 1e6,
    of which at least six are not zero. The whole body's is blind to singularities of the arm: the
    base's columns fill the lost direction.
frame : str, optional
    Default: the tool.

Raises
------
ValueError
    If a weight is out of range; bound to a robot with fewer than six joints that count.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.ur5()
>>> value, J = tk.terms.Manipulability().evaluate(robot, np.ones(6))
>>> np.allclose(value, robot.manipulability(np.ones(6)))
True
)");
  bind_measure<terms::ConditionNumber>(
      m, "ConditionNumber",
      R"(Condition number kappa = sigma_max/sigma_min, [M17] (4.32).

At a singular posture it does not exist; where the largest or the smallest singular value is not
simple, its derivative is that of a function next to it.

Parameters
----------
jacobian : 'whole_body', 'arm' or (n,)
    As for Manipulability.
frame : str, optional
    Default: the tool.

Raises
------
ValueError
    As for Manipulability.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.ur5()
>>> value, J = tk.terms.ConditionNumber().evaluate(robot, np.ones(6))
>>> np.allclose(value, robot.condition_number(np.ones(6)))
True
)");
  bind_measure<terms::Dexterity>(m, "Dexterity",
                                 R"(sqrt(kappa/M), [M17] (4.33): small where the hand moves well.

The objective of the planning scheme (4.34). At a singular posture it does not exist.

Parameters
----------
jacobian : 'whole_body', 'arm' or (n,)
    As for Manipulability.
frame : str, optional
    Default: the tool.

Raises
------
ValueError
    As for Manipulability.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> q = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
>>> whole = tk.terms.Dexterity().evaluate(robot, q)[0]
>>> np.allclose(whole, robot.dexterity(q))
True
>>> bool(tk.terms.Dexterity(jacobian="arm").evaluate(robot, q)[0] > whole)
True
)");
}

}  // namespace thing_kin::python
