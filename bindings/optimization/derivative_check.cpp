#include "thing_kin/optimization/derivative_check.hpp"

#include <algorithm>

#include "bindings.hpp"
#include "optimization/problem.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

// Differences are good to about 1e-9 where a function is smooth on the scale of 1; errors of
// derivatives are seldom small.
constexpr double kTolerance = 1e-5;

std::string place(const DerivativeDifference& at, bool is_hessian) {
  std::string place = std::string("[").append(std::to_string(at.entry));
  place.append(", ").append(std::to_string(at.row));
  return place.append(is_hessian ? std::string(", ").append(std::to_string(at.col)) : "")
      .append("]");
}

std::string describe(const DerivativeDifference& at, const char* what, bool is_hessian) {
  return std::string(what)
      .append(" differs by ")
      .append(text(at.largest))
      .append(", most at ")
      .append(place(at, is_hessian))
      .append(": ")
      .append(text(at.given))
      .append(", by differences ")
      .append(text(at.expected));
}

bool is_right(const DerivativeCheck& check) {
  return check.jacobian.largest <= kTolerance && check.hessian.largest <= kTolerance;
}

std::string message(const DerivativeCheck& check) {
  return describe(check.jacobian, "jacobian", false)
      .append("; ")
      .append(describe(check.hessian, "hessian", true));
}

}  // namespace

void bind_derivative_check(py::module_& m) {
  py::class_<DerivativeCheck>(m, "DerivativeCheck",
                              R"(How far a term's derivatives are from differences.

Examples
--------
>>> import thing_kin as tk
>>> wrong = tk.terms.Function(lambda x: x[0] ** 2, lambda x: [x[0]])
>>> check = tk.check_derivatives(wrong, [3.0])
>>> check.success, round(check.jacobian_difference, 6)
(False, 0.5)
)")
      .def_property_readonly("success", &is_right, "Whether both differences are at most 1e-5.")
      .def_property_readonly(
          "jacobian_difference", [](const DerivativeCheck& c) { return c.jacobian.largest; },
          "Largest difference, relative to the larger of 1 and the largest entry.")
      .def_property_readonly(
          "jacobian_entry",
          [](const DerivativeCheck& c) { return py::make_tuple(c.jacobian.entry, c.jacobian.row); },
          "Where: (entry of the value, variable).")
      .def_property_readonly(
          "hessian_difference", [](const DerivativeCheck& c) { return c.hessian.largest; },
          "The same of the Hessians.")
      .def_property_readonly(
          "hessian_entry",
          [](const DerivativeCheck& c) {
            return py::make_tuple(c.hessian.entry, c.hessian.row, c.hessian.col);
          },
          "Where: (entry of the value, variable, variable).")
      .def_property_readonly("message", &message, "All of it in a sentence.")
      .def("__repr__", [](const DerivativeCheck& check) {
        return std::string("DerivativeCheck(").append(message(check)).append(")");
      });

  m.def(
      "check_derivatives",
      [](const TermRecipe& term, const ArrayLike& x, const py::object& robot) {
        const std::shared_ptr<const Term> bound = term.bind(read_robot(robot));
        py::ssize_t n = bound->variables();
        if (n == 0) {
          n = dimensions_of(x) == 1
                  ? py::module_::import("numpy").attr("size")(x).cast<py::ssize_t>()
                  : 1;
        }
        const Batch batch = read(x, "x", {std::max<py::ssize_t>(n, 1)}, false);
        const Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(batch.data, batch.size);
        const py::gil_scoped_release release;
        return check_derivatives(*bound, at);
      },
      py::arg("term"), py::arg("x"), py::arg("robot") = py::none(),
      R"(Compares a term's derivatives with differences.

The Jacobian with central differences of the value, the Hessian with central differences of the
Jacobian: a function's whose Hessian is not given differs by rounding alone.

Parameters
----------
term : terms.Term
x : (n,)
robot : Chain, optional
    For terms of a robot.

Returns
-------
DerivativeCheck

Raises
------
ValueError
    If x does not fit, or the term does not exist there or next to it.

Examples
--------
>>> import thing_kin as tk
>>> term = tk.terms.Function(lambda x: x[0] ** 2, lambda x: [2 * x[0]])
>>> tk.check_derivatives(term, [3.0]).success
True
)");
}

}  // namespace thing_kin::python
