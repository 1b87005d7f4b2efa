#include "thing_kin/linalg/singular_value_filter.hpp"

#include <pybind11/operators.h>

#include "bindings.hpp"
#include "map.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

void bind_singular_value_filter(py::module_& m) {
  py::class_<SingularValueFilter>(m, "SingularValueFilter",
                                  R"(Lifts small singular values to at least sigma0, [M17] (4.12).

h(s) = (s^3 + nu s^2 + 2 s + 2 sigma0)/(s^2 + nu s + 2), after Colome & Torras: h(0) = sigma0,
h(s) > s, and h(s) tends to s for large s. It composes with every inverse.

Parameters
----------
sigma0 : float, >= 0
    What a zero singular value becomes.
nu : float, >= 0
    Shape: a larger nu changes the others less.

Raises
------
ValueError
    If the filter is not increasing in s.

Examples
--------
>>> import thing_kin as tk
>>> h = tk.SingularValueFilter(sigma0=0.01, nu=10.0)
>>> h(0.0)
0.01
)")
      .def(py::init<double, double>(), py::arg("sigma0"), py::arg("nu"))
      .def_property_readonly("sigma0", &SingularValueFilter::sigma0, "Image of zero.")
      .def_property_readonly("nu", &SingularValueFilter::nu, "Shape.")
      .def(
          "__call__",
          [](const SingularValueFilter& filter, const ArrayLike& s) {
            const Batch values = read(s, "s", {});
            for (py::ssize_t i = 0; i < values.count; ++i) {
              if (values.data[i] < 0.0) {
                throw InvalidArgument("s", text(values.data[i]), "singular values >= 0");
              }
            }
            return map_scalar(values, [&](const double* in) { return filter(*in); });
          },
          py::arg("s"), "Filtered singular values, elementwise; a number or (N,).")
      .def(py::self == py::self)
      .def(
          "__hash__",
          [](const SingularValueFilter& f) { return py::hash(py::make_tuple(f.sigma0(), f.nu())); })
      .def("__repr__",
           [](const SingularValueFilter& f) {
             return py::str("SingularValueFilter(sigma0={}, nu={})").format(f.sigma0(), f.nu());
           })
      .def(py::pickle(
          [](const SingularValueFilter& f) { return py::make_tuple(f.sigma0(), f.nu()); },
          [](const py::tuple& state) {
            return SingularValueFilter(state[0].cast<double>(), state[1].cast<double>());
          }));
  m.def(
      "filter_singular_values",
      [](const ArrayLike& J, double sigma0, double nu) {
        const SingularValueFilter filter(sigma0, nu);
        py::ssize_t rows = 0;
        py::ssize_t cols = 0;
        const Batch batch = read_matrices(J, "J", rows, cols);
        return map(batch, {rows, cols}, [&](const double* in, double* out) {
          const Batch one{in, 1, rows * cols, true, {}};
          write_matrix(filter_singular_values(matrix_at(one, 0, rows, cols), filter), out);
        });
      },
      py::arg("J"), py::arg("sigma0"), py::arg("nu"),
      R"(The matrix with its singular values lifted, [M17] (4.13).

Parameters
----------
J : (m, n) or (N, m, n)
sigma0, nu : float
    See SingularValueFilter.

Returns
-------
The same shape; no singular value is below sigma0.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> rank_one = np.array([[3.0, 0.0], [0.0, 0.0]])
>>> tk.filter_singular_values(rank_one, sigma0=0.01, nu=10.0).round(3)
array([[3.  , 0.  ],
       [0.  , 0.01]])
)");
}

}  // namespace thing_kin::python
