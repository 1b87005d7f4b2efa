#include "thing_kin/estimation/numeric_jacobian.hpp"

#include <algorithm>
#include <array>

#include "estimation_bindings.hpp"
#include "filter_arguments.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

Array vector_to_python(const double* x, py::ssize_t n) {
  Array array = make_array(&n, 1);
  std::copy_n(x, n, array.mutable_data());
  return array;
}

}  // namespace

void bind_numeric_jacobian(py::module_& m) {
  m.def(
      "numeric_jacobian",
      [](const py::function& f, const ArrayLike& x, const Indices& angles) {
        StateVector at;
        read_measurement(x, "x", at);
        StateVector value;
        read_measurement(f(vector_to_python(at.data(), at.size())), "f(x)", value);
        const auto rows = static_cast<int>(value.size());
        const std::array<py::ssize_t, 2> shape{rows, at.size()};
        Array J = make_array(shape.data(), 2);
        const auto function = [&](const double* point, double* out) {
          read_into(f(vector_to_python(point, at.size())), "f(x)", rows, value);
          std::copy_n(value.data(), rows, out);
        };
        numeric_jacobian(function, at, rows, read_angles(angles, rows), J.mutable_data());
        return J;
      },
      py::arg("f"), py::arg("x"), py::kw_only(), py::arg("angles") = py::tuple(),
      R"(The Jacobian of a function by central differences, as the extended filter takes it.

Parameters
----------
f : callable
    f(x) -> (m,), m up to 16.
x : (n,), n up to 16
angles : sequence of int
    Which entries of f(x) are angles, whose differences are the short way round.

Returns
-------
(m, n)
    With an error of about 1e-10 of f's size.

Raises
------
ValueError
    If x or what f returns is no vector of finite numbers.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> est.numeric_jacobian(lambda x: [x[0] * x[1], np.sin(x[0])], [0.0, 2.0]).round(6)
array([[2., 0.],
       [1., 0.]])
)");
}

}  // namespace thing_kin::python
