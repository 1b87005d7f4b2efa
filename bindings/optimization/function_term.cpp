#include "thing_kin/optimization/function_term.hpp"

#include <optional>
#include <utility>

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "optimization/function_term.hpp"
#include "optimization/problem.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Its own copy each time, which the user may keep.
Array to_python(const VectorView& x) { return Array(x.size(), x.data()); }

void check_callable(const py::object& function, const char* argument) {
  if (PyCallable_Check(function.ptr()) == 0) {
    throw InvalidArgument(argument, py::str(py::type::of(function).attr("__name__")), "a function");
  }
}

// What a user's function returned, as numbers; none if it returned None. The leading axis of a term
// of one entry may be missing.
std::optional<Batch> read_returned(const py::object& returned, const std::string& what,
                                   std::vector<py::ssize_t> shape) {
  if (returned.is_none()) {
    return std::nullopt;
  }
  if (shape.front() == 1 && std::cmp_equal(dimensions_of(returned) + 1, shape.size())) {
    shape.erase(shape.begin());
  }
  return read(returned, what.c_str(), shape, false);
}

struct Functions {
  std::string name;
  int size;
  py::object value, jacobian, hessian;

  std::string part(const char* which) const {
    return std::string(which).append(" of ").append(quoted(name));
  }

  bool evaluate(const VectorView& x, Eigen::Ref<Eigen::VectorXd> out, Eigen::MatrixXd* J) const {
    const py::gil_scoped_acquire lock;
    const auto numbers = read_returned(value(to_python(x)), part("value"), {size});
    if (!numbers) {
      return false;
    }
    out = Eigen::Map<const Eigen::VectorXd>(numbers->data, size);
    if (J == nullptr) {
      return true;
    }
    const auto rows = read_returned(jacobian(to_python(x)), part("jacobian"), {size, x.size()});
    if (rows) {
      *J = Eigen::Map<const RowMajor>(rows->data, size, x.size());
    }
    return rows.has_value();
  }

  void add_hessian(const VectorView& x, const VectorView& weights, Eigen::MatrixXd& H) const {
    const py::gil_scoped_acquire lock;
    const auto all =
        read_returned(hessian(to_python(x)), part("hessian"), {size, x.size(), x.size()});
    if (!all) {
      return;
    }
    for (Eigen::Index i = 0; i < size; ++i) {
      const Eigen::Map<const RowMajor> one(all->data + i * x.size() * x.size(), x.size(), x.size());
      H += 0.5 * weights[i] * (one + one.transpose());
    }
  }
};

}  // namespace

PythonFunction::PythonFunction(std::string name, int size, int n, py::object value,
                               py::object jacobian, py::object hessian)
    : name_(std::move(name)),
      size_(size),
      n_(n),
      value_(std::move(value)),
      jacobian_(std::move(jacobian)),
      hessian_(std::move(hessian)) {
  check_callable(value_, "value");
  check_callable(jacobian_, "jacobian");
  if (!hessian_.is_none()) {
    check_callable(hessian_, "hessian");
  }
  bind(nullptr);  // says what is wrong with the sizes
}

std::shared_ptr<const Term> PythonFunction::bind(const std::shared_ptr<const Chain>&) const {
  const Functions functions{name_, size_, value_, jacobian_, hessian_};
  FunctionTerm::AddHessian hessian;
  if (!hessian_.is_none()) {
    hessian = [functions](const VectorView& x, const VectorView& weights, Eigen::MatrixXd& H) {
      functions.add_hessian(x, weights, H);
    };
  }
  return std::make_shared<FunctionTerm>(
      name_, size_, n_,
      [functions](const VectorView& x, const Eigen::Ref<Eigen::VectorXd>& value,
                  Eigen::MatrixXd* J) { return functions.evaluate(x, value, J); },
      std::move(hessian));
}

void bind_function_term(py::module_& terms) {
  py::class_<PythonFunction, TermRecipe, std::shared_ptr<PythonFunction>>(terms, "Function",
                                                                          R"(A term of your own.

Parameters
----------
value : callable
    value(x) -> (size,), or a number if size is 1. None says that it does not exist at x: a step that
    leads there is not taken. NaN is an error, as is a wrong shape.
jacobian : callable
    jacobian(x) -> (size, n), d value / dx, or (n,) if size is 1. See check_derivatives.
hessian : callable, optional
    hessian(x) -> (size, n, n), or (n, n) if size is 1. Default: central differences of the Jacobian,
    2 n calls each time.
size : int
    How many numbers it gives.
n : int, optional
    How many variables it takes; default: as many as the problem has.
name : str
    For messages.

Raises
------
ValueError
    If an argument is no function or a size is below 1; later, naming the function, if it returns
    what it should not. What a function raises ends the solver and is raised there.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> circle = tk.terms.Function(
...     lambda x: x @ x, lambda x: 2 * x, lambda x: 2 * np.eye(2), name="circle")
>>> problem = tk.Problem(n=2)
>>> problem.minimize(tk.terms.Function(lambda x: x[0] + x[1], lambda x: [1.0, 1.0]))
>>> problem.at_most(circle, 2.0)
>>> tk.sqp(problem, (0.5, -0.5)).x.round(6)
array([-1., -1.])
)")
      .def(
          py::init([](const py::object& value, const py::object& jacobian,
                      const py::object& hessian, int size, std::optional<int> n, std::string name) {
            if (n && *n < 1) {
              throw InvalidArgument("n", std::to_string(*n), "at least 1, or None");
            }
            return std::make_shared<PythonFunction>(std::move(name), size, n.value_or(0), value,
                                                    jacobian, hessian);
          }),
          py::arg("value"), py::arg("jacobian"), py::arg("hessian") = py::none(), py::kw_only(),
          py::arg("size") = 1, py::arg("n") = py::none(), py::arg("name") = "function")
      .def_property_readonly("size", &PythonFunction::size, "How many numbers it gives.")
      .def("__repr__", [](const PythonFunction& function) {
        return py::str("Function({!r}, size={})").format(function.name(), function.size());
      });
}

}  // namespace thing_kin::python
