#include "optimization/term_recipe.hpp"

#include <utility>

#include "bindings.hpp"

namespace thing_kin::python {

/// An argument `robot`: a Chain or None.
class OptionalRobot : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(OptionalRobot, object, [](PyObject*) { return 1; })
};

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::OptionalRobot> {
  static constexpr auto name = const_name("thing_kin._core.Chain | None");
};

}  // namespace pybind11::detail

namespace thing_kin::python {

namespace {

/// A term bound to a robot that lives at least as long as the call.
std::shared_ptr<const Term> bound(const TermRecipe& recipe, const OptionalRobot& robot) {
  if (robot.is_none()) {
    return recipe.bind(nullptr);
  }
  if (!py::isinstance<Chain>(robot)) {
    throw InvalidArgument("robot", py::str(py::type::of(robot).attr("__name__")),
                          "a Chain or None");
  }
  const auto* chain = robot.cast<const Chain*>();
  return recipe.bind(std::shared_ptr<const Chain>(std::shared_ptr<const Chain>(), chain));
}

Batch read_variables(const Term& term, const ArrayLike& q) {
  py::ssize_t n = term.variables();
  if (n == 0) {  // any number
    const auto array = py::array::ensure(q);
    PyErr_Clear();
    n = array && array.ndim() > 0 ? array.shape(array.ndim() - 1) : 1;
  }
  Batch batch = read(q, "q", {n});
  check_magnitude(batch, "q");
  return batch;
}

[[noreturn]] void refuse(const Term& term) {
  throw InvalidArgument("q", "a configuration without " + term.name(),
                        "one where it exists with its derivative: no singular posture");
}

std::pair<Array, Array> evaluate_term(const TermRecipe& recipe, const OptionalRobot& robot,
                                      const ArrayLike& q) {
  const auto term = bound(recipe, robot);
  const Batch batch = read_variables(*term, q);
  const py::ssize_t n = batch.size;
  const py::ssize_t m = term->size();
  Array values = make_array(batch, {m});
  Array jacobians = make_array(batch, {m, n});
  double* const to_values = values.mutable_data();
  double* const to_jacobians = jacobians.mutable_data();
  Eigen::VectorXd value(m);
  Eigen::MatrixXd J(m, n);
  for (py::ssize_t i = 0; i < batch.count; ++i) {
    if (!term->evaluate(Eigen::Map<const Eigen::VectorXd>(batch.item(i), n), value, &J)) {
      refuse(*term);
    }
    Eigen::Map<Eigen::VectorXd>(to_values + i * m, m) = value;
    write_matrix(J, to_jacobians + i * m * n);
  }
  return {values, jacobians};
}

Array hessian(const TermRecipe& recipe, const OptionalRobot& robot, const ArrayLike& q,
              const OptionalArray& weights) {
  const auto term = bound(recipe, robot);
  const Batch batch = read_variables(*term, q);
  const py::ssize_t n = batch.size;
  Eigen::VectorXd share = Eigen::VectorXd::Ones(term->size());
  if (!weights.is_none()) {
    const Batch given = read(weights, "weights", {term->size()}, false);
    share = Eigen::Map<const Eigen::VectorXd>(given.data, given.size);
  }
  Array hessians = make_array(batch, {n, n});
  double* const to = hessians.mutable_data();
  Eigen::VectorXd value(term->size());
  Eigen::MatrixXd H(n, n);
  for (py::ssize_t i = 0; i < batch.count; ++i) {
    const Eigen::Map<const Eigen::VectorXd> x(batch.item(i), n);
    if (!term->evaluate(x, value, nullptr)) {
      refuse(*term);
    }
    H.setZero();
    term->add_hessian(x, share, H);
    write_matrix(H, to + i * n * n);
  }
  return hessians;
}

}  // namespace

void bind_term_recipe(py::module_& terms) {
  py::class_<TermRecipe, std::shared_ptr<TermRecipe>>(
      terms, "Term", R"(What objectives and constraints are made of: the base of all terms.

A term is a vector function of the configuration with exact first and second derivatives. It is
made without a robot; a Problem binds it to its own. Immutable.

Examples
--------
>>> import thing_kin as tk
>>> isinstance(tk.terms.Dexterity(), tk.terms.Term)
True
)")
      .def_property_readonly("name", &TermRecipe::name, "For messages and traces: 'pose'.")
      .def("evaluate", &evaluate_term, py::arg("robot"), py::arg("q"),
           R"(The term's numbers and their derivatives.

Parameters
----------
robot : Chain or None
    None for a term of a problem without a robot.
q : (n,) or (N, n), rad and m

Returns
-------
value : (m,) or (N, m)
jacobian : (m, n) or (N, m, n)
    d value/dq.

Raises
------
ValueError
    If the term does not fit the robot, a shape is wrong, or the term or its derivative does not
    exist at q, as a condition number at a singular posture.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> value, J = tk.terms.BaseDistance((3.0, 4.0)).evaluate(robot, np.zeros(9))
>>> value, J[0, 6:8]
(array([5.]), array([-0.6, -0.8]))
)")
      .def("hessian", &hessian, py::arg("robot"), py::arg("q"), py::arg("weights") = py::none(),
           R"(The second derivative of a weighted sum of the term's numbers.

Parameters
----------
robot : Chain or None
q : (n,) or (N, n), rad and m
weights : (m,), optional
    Of each number; default: ones.

Returns
-------
(n, n) or (N, n, n)
    sum_i weights_i d^2 value_i/dq^2, symmetric.

Raises
------
ValueError
    As evaluate().

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.terms.SeedDistance([0.0, 0.0]).hessian(None, [3.0, 4.0])
array([[2., 0.],
       [0., 2.]])
)");
}

}  // namespace thing_kin::python
