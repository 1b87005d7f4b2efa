#include "thing_kin/optimization/terms_joints.hpp"

#include "bindings.hpp"
#include "optimization/term_recipe.hpp"

namespace thing_kin::python {

void bind_terms_joints(py::module_& m) {
  TermClass<terms::SeedDistance>(m, "SeedDistance",
                                 R"(sum_i w_i (q_i - seed_i)^2, [M17] (4.25).

Continuous joints go the shorter way round. Serves problems without a robot too.

Parameters
----------
seed : (n,), rad and m
weights : float or (n,), optional
    At least 0; default: 1.

Raises
------
ValueError
    If a weight is negative, the shapes differ, or a number is not finite.

Examples
--------
>>> import thing_kin as tk
>>> tk.terms.SeedDistance([1.0, 2.0], weights=[1.0, 10.0]).evaluate(None, [1.0, 2.5])[0]
array([2.5])
)")
      .def(py::init([](const ArrayLike& seed, const OptionalArray& weights) {
             Eigen::VectorXd center = read_any_vector(seed, "seed");
             Eigen::VectorXd numbers = read_weights(weights, "weights", center.size());
             return terms::SeedDistance(std::move(center), std::move(numbers));
           }),
           py::arg("seed"), py::arg("weights") = py::none())
      .def_property_readonly(
          "seed", [](const terms::SeedDistance& term) { return frozen_copy(term.seed()); },
          "(n,), rad and m.")
      .def_property_readonly(
          "weights", [](const terms::SeedDistance& term) { return frozen_copy(term.weights()); },
          "(n,).")
      .def("__repr__", [](const terms::SeedDistance& term) {
        return py::str("SeedDistance({} joints)").format(term.seed().size());
      });
  TermClass<terms::JointCentering>(
      m, "JointCentering",
      R"(sum_i ((q_i - middle_i)/range_i)^2 over joints with two limits.

A joint at one of its limits adds 1/4.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.ur5()
>>> tk.terms.JointCentering().evaluate(robot, robot.upper)[0]
array([1.5])
)")
      .def(py::init<>())
      .def("__repr__", [](const terms::JointCentering& /*term*/) { return "JointCentering()"; });
}

}  // namespace thing_kin::python
