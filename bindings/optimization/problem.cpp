#include "optimization/problem.hpp"

#include <optional>

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

// One number for all entries or one each; -inf and inf pass.
Eigen::VectorXd read_bounds(const py::object& bounds, const char* name, py::ssize_t size) {
  const bool is_number = dimensions_of(bounds) == 0;
  const Batch read_in = is_number ? read(bounds, name, {}, false, Finite::kNo)
                                  : read(bounds, name, {size}, false, Finite::kNo);
  Eigen::VectorXd all =
      is_number ? Eigen::VectorXd::Constant(size, *read_in.data)
                : Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(read_in.data, size));
  if (all.array().isNaN().any()) {
    throw InvalidArgument(name, "nan", "numbers");
  }
  return all;
}

Eigen::VectorXd read_x(const py::object& x, const char* name, const Problem& problem) {
  const Batch batch = read(x, name, {problem.variables()}, false);
  return Eigen::Map<const Eigen::VectorXd>(batch.data, batch.size);
}

std::shared_ptr<const Term> bind_to(const Problem& problem, const TermRecipe& term) {
  return term.bind(problem.robot());
}

void constrain(Problem& problem, const TermRecipe& recipe, const py::object* lower,
               const char* lower_name, const py::object* upper, const char* upper_name,
               const std::string& name) {
  const std::shared_ptr<const Term> term = bind_to(problem, recipe);
  const auto side = [&](const py::object* bounds, const char* argument, double none) {
    return bounds == nullptr ? Eigen::VectorXd(Eigen::VectorXd::Constant(term->size(), none))
                             : read_bounds(*bounds, argument, term->size());
  };
  problem.constrain(term, side(lower, lower_name, -kInfinity), side(upper, upper_name, kInfinity),
                    name);
}

int read_variable(const Problem& problem, const py::object& variable) {
  if (py::isinstance<py::str>(variable)) {
    return problem.variable(variable.cast<std::string>());
  }
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(variable.ptr()));
  if (!index) {
    PyErr_Clear();
    throw InvalidArgument("variable", py::str(py::type::of(variable).attr("__name__")),
                          "a name or an index");
  }
  int overflow = 0;
  const long place = PyLong_AsLongAndOverflow(index.ptr(), &overflow);
  if (overflow != 0 || place < 0 || place >= problem.variables()) {
    throw InvalidArgument("variable", py::str(index),
                          std::string("0 to ").append(std::to_string(problem.variables() - 1)));
  }
  return static_cast<int>(place);
}

std::shared_ptr<Problem> make_problem(const py::object& robot, std::optional<int> n,
                                      const py::object& lower, const py::object& upper) {
  if (!robot.is_none()) {
    if (n || !lower.is_none() || !upper.is_none()) {
      throw InvalidArgument(n                 ? "n"
                            : lower.is_none() ? "upper"
                                              : "lower",
                            "a value beside robot",
                            "one of the two: a robot brings its own; see Problem.bound");
    }
    return std::make_shared<Problem>(read_robot(robot));
  }
  if (!n || *n < 1) {
    throw InvalidArgument("n", n ? std::to_string(*n) : "None", "at least 1, or a robot");
  }
  const auto side = [&](const py::object& bounds, const char* name, double none) {
    return bounds.is_none() ? Eigen::VectorXd(Eigen::VectorXd::Constant(*n, none))
                            : read_bounds(bounds, name, *n);
  };
  return std::make_shared<Problem>(side(lower, "lower", -kInfinity),
                                   side(upper, "upper", kInfinity));
}

// What problem.evaluate() gives.
struct Evaluation {
  Linearization at;
  std::vector<Violation> violations;
};

Evaluation evaluate(const Problem& problem, const ArrayLike& x) {
  const Eigen::VectorXd at = read_x(x, "x", problem);
  Evaluation evaluation;
  const py::gil_scoped_release release;
  if (!problem.linearize(at, evaluation.at)) {
    throw InvalidArgument("x",
                          std::string("a point where ")
                              .append(quoted(problem.undefined_at(at)))
                              .append(" does not exist"),
                          "one where all terms and their derivatives do");
  }
  evaluation.violations = problem.violations(at, evaluation.at.value, 0.0);
  return evaluation;
}

py::dict to_dict(const std::vector<Violation>& violations) {
  py::dict named;
  for (const Violation& violation : violations) {
    named[py::str(violation.name)] = violation.amount;
  }
  return named;
}

void bind_evaluation(py::module_& m) {
  py::class_<Evaluation>(m, "ProblemValue", R"(A problem at one x.

Examples
--------
>>> import thing_kin as tk
>>> problem = tk.Problem(n=2, upper=1.0)
>>> problem.minimize(tk.terms.Function(lambda x: x @ x, lambda x: 2 * x))
>>> at = problem.evaluate((3.0, 0.0))
>>> at.objective, at.violation, at.violations
(9.0, 2.0, {'bound of x[0]': 2.0})
)")
      .def_property_readonly(
          "objective", [](const Evaluation& e) { return e.at.objective; }, "f(x).")
      .def_property_readonly(
          "gradient", [](const Evaluation& e) { return to_array(e.at.gradient); },
          "(n,), of the objective.")
      .def_property_readonly(
          "values", [](const Evaluation& e) { return to_array(e.at.value); },
          "(m,), of the constraints, in the order of constraint_names.")
      .def_property_readonly(
          "jacobian", [](const Evaluation& e) { return to_array(e.at.jacobian); },
          "(m, n), of the constraints.")
      .def_property_readonly(
          "violation",
          [](const Evaluation& e) {
            return e.violations.empty() ? 0.0 : e.violations.front().amount;
          },
          "The largest of a constraint or bound.")
      .def_property_readonly(
          "violations", [](const Evaluation& e) { return to_dict(e.violations); },
          "Constraints and bounds that do not hold, by name: by how much; the worst first.")
      .def("__repr__", [](const Evaluation& e) {
        return py::str("ProblemValue(objective={:.6g}, violations={})")
            .format(e.at.objective, to_dict(e.violations));
      });
}

}  // namespace

std::shared_ptr<const Chain> read_robot(const py::object& robot) {
  if (robot.is_none()) {
    return nullptr;
  }
  if (!py::isinstance<Chain>(robot)) {
    throw InvalidArgument("robot", py::str(py::type::of(robot).attr("__name__")), "a Chain");
  }
  return std::make_shared<const Chain>(robot.cast<const Chain&>());
}

int dimensions_of(const py::object& array) {
  try {
    return py::module_::import("numpy").attr("ndim")(array).cast<int>();
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_Exception) || error.matches(PyExc_MemoryError)) {
      throw;
    }
    return -1;
  }
}

void bind_problem(py::module_& m) {
  bind_evaluation(m);
  const py::object none = py::none();
  PyProblem problem(m, "Problem", R"(An optimization problem, [M17] (4.19).

Minimize a sum of terms, where other terms are bounded and the variables are. For a robot the
variables are its joints, bounded by its limits; otherwise there are n of them.

Bounds that cross, such as a lower one above the upper, are kept: a solver says that it is
infeasible.

Parameters
----------
robot : Chain, optional
n : int, optional
    How many variables, without a robot.
lower, upper : float or (n,), optional
    Bounds of the variables, without a robot; default none.

Raises
------
ValueError
    If there is neither a robot nor n, or both; for NaN and wrong shapes.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> problem = tk.Problem(n=2, lower=0.0)
>>> problem.minimize(tk.terms.Function(lambda x: x @ x, lambda x: 2 * x, name="size"))
>>> problem.equal(tk.terms.Function(lambda x: x.sum(), np.ones_like, name="sum"), 1.0)
>>> problem
Problem(2 variables, 1 objective, 1 constraint)
>>> tk.sqp(problem, (1.0, 0.0)).x.round(6)
array([0.5, 0.5])
)");
  problem.def(py::init(&make_problem), py::arg("robot") = none, py::kw_only(), py::arg("n") = none,
              py::arg("lower") = none, py::arg("upper") = none);
  problem
      .def(
          "minimize",
          [](Problem& self, const TermRecipe& term, double weight) {
            self.minimize(bind_to(self, term), weight);
          },
          py::arg("term"), py::arg("weight") = 1.0,
          R"(Adds to the objective: the sum of the entries.

Parameters
----------
term : terms.Term
weight : float
    A negative one maximizes.

Raises
------
ValueError
    If the term does not fit, or the weight is not finite.

Examples
--------
>>> import thing_kin as tk
>>> problem = tk.Problem(n=1)
>>> problem.minimize(tk.terms.Function(lambda x: x**2, lambda x: 2 * x), weight=3.0)
>>> problem.evaluate([2.0]).objective
12.0
)")
      .def(
          "minimize_squares",
          [](Problem& self, const TermRecipe& term, double weight) {
            self.minimize_squares(bind_to(self, term), weight);
          },
          py::arg("term"), py::arg("weight") = 1.0,
          R"(Adds to the objective: the sum of the entries' squares.

Parameters
----------
term : terms.Term
weight : float >= 0

Raises
------
ValueError
    If the term does not fit, or the weight is negative or not finite.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> problem = tk.Problem(n=2)
>>> problem.minimize_squares(tk.terms.Function(lambda x: x - 1, lambda x: np.eye(2), size=2))
>>> problem.evaluate([2.0, 3.0]).objective
5.0
)")
      .def(
          "equal",
          [](Problem& self, const TermRecipe& term, const ArrayLike& target,
             const std::string& name) {
            const std::shared_ptr<const Term> bound = bind_to(self, term);
            const Eigen::VectorXd value = read_bounds(target, "target", bound->size());
            if (!value.allFinite()) {
              throw InvalidArgument("target", "inf", "finite numbers");
            }
            self.constrain(bound, value, value, name);
          },
          py::arg("term"), py::arg("target") = 0.0, py::kw_only(), py::arg("name") = "",
          R"(Adds a constraint: the term equals the target.

Parameters
----------
term : terms.Term
target : float or (m,)
name : str
    For messages; default the term's.

Raises
------
ValueError
    If the term or the target does not fit.

Examples
--------
>>> import thing_kin as tk
>>> problem = tk.Problem(n=1)
>>> problem.equal(tk.terms.Function(lambda x: x**2, lambda x: 2 * x), 4.0, name="square")
>>> problem.evaluate([3.0]).violations
{'square': 5.0}
)")
      .def(
          "at_most",
          [](Problem& self, const TermRecipe& term, const ArrayLike& upper,
             const std::string& name) {
            constrain(self, term, nullptr, "", &upper, "upper", name);
          },
          py::arg("term"), py::arg("upper"), py::kw_only(), py::arg("name") = "",
          R"(Adds a constraint: the term is at most `upper`.

Parameters
----------
term : terms.Term
upper : float or (m,)
name : str
    For messages; default the term's.

Raises
------
ValueError
    If the term or the bound does not fit.

Examples
--------
>>> import thing_kin as tk
>>> problem = tk.Problem(n=1)
>>> problem.at_most(tk.terms.Function(lambda x: x**2, lambda x: 2 * x, name="square"), 4.0)
>>> problem.evaluate([3.0]).violations
{'square': 5.0}
)")
      .def(
          "at_least",
          [](Problem& self, const TermRecipe& term, const ArrayLike& lower,
             const std::string& name) {
            constrain(self, term, &lower, "lower", nullptr, "", name);
          },
          py::arg("term"), py::arg("lower"), py::kw_only(), py::arg("name") = "",
          R"(Adds a constraint: the term is at least `lower`.

Parameters
----------
term : terms.Term
lower : float or (m,)
name : str
    For messages; default the term's.

Raises
------
ValueError
    If the term or the bound does not fit.

Examples
--------
>>> import thing_kin as tk
>>> problem = tk.Problem(n=1)
>>> problem.at_least(tk.terms.Function(lambda x: x**2, lambda x: 2 * x, name="square"), 4.0)
>>> problem.evaluate([1.0]).violations
{'square': 3.0}
)")
      .def(
          "between",
          [](Problem& self, const TermRecipe& term, const ArrayLike& lower, const ArrayLike& upper,
             const std::string& name) {
            constrain(self, term, &lower, "lower", &upper, "upper", name);
          },
          py::arg("term"), py::arg("lower"), py::arg("upper"), py::kw_only(), py::arg("name") = "",
          R"(Adds a constraint: the term is between two bounds.

Parameters
----------
term : terms.Term
lower, upper : float or (m,)
name : str
    For messages; default the term's.

Raises
------
ValueError
    If the term or a bound does not fit.

Examples
--------
>>> import thing_kin as tk
>>> problem = tk.Problem(n=1)
>>> problem.between(tk.terms.Function(lambda x: x**2, lambda x: 2 * x, name="square"), 1.0, 4.0)
>>> problem.evaluate([0.0]).violations
{'square': 1.0}
)")
      .def(
          "bound",
          [](Problem& self, const py::object& variable, const ArrayLike& lower,
             const ArrayLike& upper) {
            const auto number = [](const py::object& value, const char* name) {
              return *read(value, name, {}, false, Finite::kNo).data;
            };
            self.bound(read_variable(self, variable), number(lower, "lower"),
                       number(upper, "upper"));
          },
          py::arg("variable"), py::arg("lower") = -kInfinity, py::arg("upper") = kInfinity,
          R"(Bounds a variable anew, in place of what bounded it before.

Parameters
----------
variable : str or int
    A joint by name, or its place.
lower, upper : float, rad or m
    -inf and inf: none.

Raises
------
ValueError
    If there is no such variable, or a bound is NaN.

Examples
--------
>>> import thing_kin as tk
>>> problem = tk.Problem(tk.robots.thing())
>>> problem.bound("theta", -0.5, 0.5)
>>> float(problem.upper[problem.names.index("theta")])
0.5
)")
      .def("evaluate", &evaluate, py::arg("x"), R"(Objective and constraints at x.

Parameters
----------
x : (n,)

Returns
-------
ProblemValue

Raises
------
ValueError
    If x does not fit, or a term does not exist there.

Examples
--------
>>> import thing_kin as tk
>>> problem = tk.Problem(n=2, upper=1.0)
>>> problem.evaluate((3.0, 0.5)).violations
{'bound of x[0]': 2.0}
)")
      .def_property_readonly(
          "n", [](const Problem& self) { return self.variables(); }, "How many variables.")
      .def_property_readonly(
          "names", [](const Problem& self) { return py::tuple(py::cast(self.names())); },
          "Names of the variables.")
      .def_property_readonly(
          "lower", [](const Problem& self) { return to_array(self.lower()); },
          "(n,): lower bounds of the variables.")
      .def_property_readonly(
          "upper", [](const Problem& self) { return to_array(self.upper()); },
          "(n,): upper bounds of the variables.")
      .def_property_readonly(
          "constraint_names",
          [](const Problem& self) {
            std::vector<std::string> names;
            names.reserve(static_cast<std::size_t>(self.rows()));
            for (int row = 0; row < self.rows(); ++row) {
              names.push_back(self.row_name(row));
            }
            return py::tuple(py::cast(names));
          },
          "Names of the m numbers that are bounded.")
      .def_property_readonly(
          "constraint_lower", [](const Problem& self) { return to_array(self.row_lower()); },
          "(m,): their lower bounds.")
      .def_property_readonly(
          "constraint_upper", [](const Problem& self) { return to_array(self.row_upper()); },
          "(m,): their upper bounds.")
      .def("__repr__", [](const Problem& self) {
        const auto count = [](std::size_t number, const char* what) {
          return std::to_string(number).append(" ").append(what).append(number == 1 ? "" : "s");
        };
        return std::string("Problem(")
            .append(count(self.names().size(), "variable"))
            .append(", ")
            .append(count(self.objectives().size(), "objective"))
            .append(", ")
            .append(count(self.constraints().size(), "constraint"))
            .append(")");
      });
}

}  // namespace thing_kin::python
