#include "thing_kin/optimization/sqp.hpp"

#include <memory>
#include <optional>
#include <utility>

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "optimization/problem.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/optimization/elastic_qp.hpp"

namespace thing_kin::python {

namespace {

using Minimizer = std::shared_ptr<ConvexMinimizer>;

// Those of Ceres are in an extension of their own, which is loaded here.
Minimizer make_minimizer(const std::string& name) {
  if (name == "qp") {
    return std::make_shared<ElasticQp>();
  }
  if (name != "augmented_lagrangian" && name != "smoothed" && name != "bfgs") {
    throw InvalidArgument("minimizer", quoted(name),
                          "'augmented_lagrangian', 'smoothed', 'bfgs' or 'qp'");
  }
  try {
    return py::module_::import("thing_kin._ceres").attr("minimizer")(name).cast<Minimizer>();
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ImportError)) {
      throw;
    }
    py::raise_from(
        error, PyExc_ImportError,
        "thing_kin was built without Ceres, or its library is missing; on Debian install "
        "libceres-dev, then build with -DTHING_KIN_CERES=ON (the default). minimizer='qp' "
        "needs none");
    throw py::error_already_set();
  }
}

template <typename Value>
py::array_t<Value> column(const std::vector<Value>& values) {
  py::array_t<Value> array(static_cast<py::ssize_t>(values.size()));
  std::copy(values.begin(), values.end(), array.mutable_data());
  return array;
}

py::object run(const Problem& problem, const ArrayLike& x0, const std::string& minimizer,
               SqpOptions options, std::optional<double> deadline) {
  options.deadline = deadline.value_or(options.deadline);
  options.check();
  const Batch start = read(x0, "x0", {problem.variables()}, false);
  check_magnitude(start, "x0");
  const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(start.data, start.size);
  const Minimizer with = make_minimizer(minimizer);
  SqpResult result;
  {
    const py::gil_scoped_release release;
    result = sqp(problem, x, *with, options);
  }
  return py::cast(std::move(result));
}

void bind_trace(py::module_& m) {
  py::class_<SqpTrace>(m, "SqpTrace", R"(What tk.sqp did: an entry a convexified problem.

See viz.plot_trace.

Examples
--------
>>> import thing_kin as tk
>>> problem = tk.Problem(n=1)
>>> problem.minimize(tk.terms.Function(lambda x: x[0] ** 4, lambda x: 4 * x**3))
>>> trace = tk.sqp(problem, [1.0]).trace
>>> len(trace) == len(trace.merit), bool(trace.objective[0] > trace.objective[-1])
(True, True)
)")
      .def_property_readonly(
          "merit", [](const SqpTrace& t) { return column(t.merit); },
          "(N,): f + penalty sum |violation| where the step was tried from; of the violation alone "
          "while that is restored.")
      .def_property_readonly(
          "objective", [](const SqpTrace& t) { return column(t.objective); }, "(N,).")
      .def_property_readonly(
          "violation", [](const SqpTrace& t) { return column(t.violation); },
          "(N,): the largest of a constraint.")
      .def_property_readonly(
          "radius", [](const SqpTrace& t) { return column(t.radius); },
          "(N,): of the trust region, in each variable.")
      .def_property_readonly(
          "penalty", [](const SqpTrace& t) { return column(t.penalty); }, "(N,): mu.")
      .def_property_readonly(
          "accepted", [](const SqpTrace& t) { return column(t.accepted); },
          "(N,) bool: whether the step was taken.")
      .def("__len__", [](const SqpTrace& t) { return t.merit.size(); });
}

void bind_result(py::module_& m) {
  const auto x = [](const SqpResult& r) { return to_array(r.x); };
  py::class_<SqpResult>(m, "SqpResult", R"(What tk.sqp found, judged anew at its x.

x is always finite and within bounds that do not cross. Violation and residual are computed from the
problem at x, not by the solver.

Examples
--------
>>> import thing_kin as tk
>>> problem = tk.Problem(n=1, upper=1.0)
>>> problem.equal(tk.terms.Function(lambda x: x, lambda x: [[1.0]], name="place"), 3.0)
>>> result = tk.sqp(problem, [0.0])
>>> result.success, result.status, result.message
(False, 'infeasible', 'infeasible: place by 2')
)")
      .def_property_readonly("x", x, "(n,).")
      .def_property_readonly("q", x, "(n,): x by its name for a robot, rad and m.")
      .def_property_readonly("success", &SqpResult::success, "Whether status is 'converged'.")
      .def_property_readonly(
          "status", [](const SqpResult& r) { return to_string(r.status); },
          R"(How it ended.

'converged': feasible and stationary, both within tolerance. 'infeasible': constraints are violated,
and no step lessens the sum of the violations. 'budget': iterations or time ran out, or no step makes
progress though x is not stationary; x is the best point found, feasible or not.)")
      .def_readonly("message", &SqpResult::message, "The status in a sentence: what is violated.")
      .def_readonly("objective", &SqpResult::objective, "f(x).")
      .def_readonly("constraint_violation", &SqpResult::constraint_violation,
                    "The largest of a constraint or bound.")
      .def_readonly(
          "kkt_residual", &SqpResult::kkt_residual,
          "How far x is from stationary: what is left of the Lagrangian's gradient, relative "
          "to the largest of 1, the objective's gradient and the constraints' pulls, or a "
          "multiplier times its slack, relative to the first two.")
      .def_property_readonly(
          "multipliers", [](const SqpResult& r) { return to_array(r.multipliers); },
          "(m,), of the constraints, in the order of Problem.constraint_names; > 0: at the upper "
          "bound, < 0: at the lower.")
      .def_property_readonly(
          "bound_multipliers", [](const SqpResult& r) { return to_array(r.bound_multipliers); },
          "(n,), of the variables' bounds.")
      .def_readonly("iterations", &SqpResult::iterations, "Convexified problems solved.")
      .def_readonly("time", &SqpResult::time, "Seconds.")
      .def_readonly("trace", &SqpResult::trace, "SqpTrace: an entry an iteration.")
      .def("__repr__", [](const SqpResult& r) {
        return py::str("SqpResult({}; objective {:.6g}, {} iterations, {:.3g} ms)")
            .format(r.message, r.objective, r.iterations, 1e3 * r.time);
      });
}

}  // namespace

void bind_sqp(py::module_& m) {
  // What thing_kin._ceres makes, to be passed on.
  const py::class_<ConvexMinimizer, Minimizer> opaque(m, "_ConvexMinimizer");
  bind_trace(m);
  bind_result(m);
  const SqpOptions defaults;
  m.def(
      "sqp",
      [](const Problem& problem, const ArrayLike& x0, const std::string& minimizer, double c,
         double tau_plus, double tau_minus, double k, double mu0, double mu_max, double delta0,
         double delta_min, double delta_max, double step_tolerance, double improvement_tolerance,
         double constraint_tolerance, double optimality_tolerance, bool second_order_correction,
         int max_iterations, std::optional<double> deadline) {
        return run(problem, x0, minimizer,
                   {c, tau_plus, tau_minus, k, mu0, mu_max, delta0, delta_min, delta_max,
                    step_tolerance, improvement_tolerance, constraint_tolerance,
                    optimality_tolerance, second_order_correction, max_iterations},
                   deadline);
      },
      py::arg("problem"), py::arg("x0"), py::kw_only(),
      py::arg("minimizer") = "augmented_lagrangian", py::arg("c") = defaults.c,
      py::arg("tau_plus") = defaults.tau_plus, py::arg("tau_minus") = defaults.tau_minus,
      py::arg("k") = defaults.k, py::arg("mu0") = defaults.mu0, py::arg("mu_max") = defaults.mu_max,
      py::arg("delta0") = defaults.delta0, py::arg("delta_min") = defaults.delta_min,
      py::arg("delta_max") = defaults.delta_max,
      py::arg("step_tolerance") = defaults.step_tolerance,
      py::arg("improvement_tolerance") = defaults.improvement_tolerance,
      py::arg("constraint_tolerance") = defaults.constraint_tolerance,
      py::arg("optimality_tolerance") = defaults.optimality_tolerance,
      py::arg("second_order_correction") = defaults.second_order_correction,
      py::arg("max_iterations") = defaults.max_iterations, py::arg("deadline") = py::none(),
      R"(Sequential convex optimization, [M17] Algorithm 2.

Three loops: the innermost minimizes a convex model of objective and constraints in a trust region,
and accepts the step if the exact merit f + mu sum |violation| improves as the model predicts; the
second makes the model anew; the outermost raises the penalty mu until the constraints hold. Where
that does not help, the violation alone is minimized. The model has the exact second derivatives of
the Lagrangian, made convex.

It finds a local optimum. The result is a function of problem, x0 and options alone, unless there is
a deadline.

Parameters
----------
problem : Problem
x0 : (n,)
    Where to begin; brought into the bounds first.
minimizer : str
    Of the convex model. 'augmented_lagrangian': through Ceres' Levenberg-Marquardt, as [M17] 5.3.2.
    'smoothed': the same, of penalties rounded over 1e-9. 'bfgs': an augmented Lagrangian through
    Ceres' BFGS line search. 'qp': a quadratic program with elastic constraints by an interior point
    method of this library, several times faster.
c : float
    Least ratio of actual to predicted improvement for a step to be taken.
tau_plus, tau_minus : float
    Growth of the trust region where a step is taken, its shrinking where not.
k, mu0, mu_max : float
    Growth of the penalty, the first and the largest.
delta0, delta_min, delta_max : float
    Radius of the trust region in each variable: first, least, largest.
step_tolerance : float
    A step no entry of which is larger counts as none.
improvement_tolerance : float
    A predicted improvement of the merit that counts as none, relative to it and to 1.
constraint_tolerance : float
    Of each constraint, in its own unit. Bounds of the variables always hold.
optimality_tolerance : float
    Of SqpResult.kkt_residual.
second_order_correction : bool
    Whether a step that is refused is tried again with the constraints' values at its end. Without
    it, curved constraints can keep the last steps from being full (the Maratos effect).
max_iterations : int
    Convexified problems solved, in all loops together.
deadline : float, s, optional

Returns
-------
SqpResult

Raises
------
ValueError
    If x0 or an option does not fit; if a function of a term returns what it should not.
ImportError
    If the minimizer needs Ceres and there is none.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> rosenbrock = tk.terms.Function(
...     lambda x: [10 * (x[1] - x[0] ** 2), 1 - x[0]],
...     lambda x: [[-20 * x[0], 10], [-1, 0]], size=2)
>>> disc = tk.terms.Function(lambda x: x @ x, lambda x: 2 * x, lambda x: 2 * np.eye(2))
>>> problem = tk.Problem(n=2)
>>> problem.minimize_squares(rosenbrock)
>>> problem.at_most(disc, 1.0)
>>> result = tk.sqp(problem, (-1.0, 0.5))
>>> result.success, result.x.round(4)
(True, array([0.7864, 0.6177]))
)");
}

}  // namespace thing_kin::python
