#include "thing_kin/estimation/consistency.hpp"

#include <array>
#include <cmath>
#include <string>

#include "estimation_bindings.hpp"
#include "filter_arguments.hpp"
#include "map.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

// The n of an (n, n) or (N, n, n) argument.
py::ssize_t last_axis(const ArrayLike& P) {
  py::ssize_t rows = 0;
  py::ssize_t cols = 0;
  read_matrices(P, "P", rows, cols);
  if (rows != cols || rows > kMaxState) {
    throw InvalidArgument(
        "P",
        "matrices of " + std::to_string(rows) + " rows and " + std::to_string(cols) + " columns",
        "square ones of up to " + std::to_string(kMaxState));
  }
  return rows;
}

FloatOrArray nees(const ArrayLike& truth, const ArrayLike& x, const ArrayLike& P,
                  const Indices& angles) {
  const py::ssize_t n = last_axis(P);
  Batches<3> batches{read(truth, "truth", {n}), read(x, "x", {n}), read(P, "P", {n, n})};
  py::ssize_t count = 1;
  bool single = true;
  for (const Batch& batch : batches) {
    count = batch.single ? count : batch.count;
    single = single && batch.single;
  }
  constexpr std::array<const char*, 3> kNames{"truth", "x", "P"};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!batches[k].single && batches[k].count != count) {
      throw InvalidArgument(kNames[k], std::to_string(batches[k].count) + " rows",
                            "as many in all, " + std::to_string(count));
    }
  }
  const AngleSet set = read_angles(angles, static_cast<int>(n));
  const Serial serial;
  Array out =
      map_together(batches, {}, Run{serial.out, serial.threads},
                   [&](const std::array<const double*, 3>& in, double* to) {
                     *to = normalized_error_squared(in[0], in[1], in[2], static_cast<int>(n), set);
                   });
  for (py::ssize_t i = 0; i < out.size(); ++i) {
    if (!std::isfinite(out.data()[i])) {
      check_magnitude(batches[0], "truth");
      check_magnitude(batches[1], "x");
      throw InvalidArgument("P", "a matrix without an inverse, in row " + std::to_string(i),
                            "positive definite covariances");
    }
  }
  if (single) {
    return py::reinterpret_steal<FloatOrArray>(PyFloat_FromDouble(*out.data()));
  }
  return py::reinterpret_steal<FloatOrArray>(out.release());
}

}  // namespace

void bind_consistency(py::module_& m) {
  m.def("nees", &nees, py::arg("truth"), py::arg("x"), py::arg("P"), py::kw_only(),
        py::arg("angles") = py::tuple(),
        R"(Normalized estimation error squared, (truth - x)^T P^-1 (truth - x).

Of a consistent filter it is chi-square with n degrees of freedom; see consistency.

Parameters
----------
truth : (n,) or (N, n), n up to 16
x : (n,) or (N, n)
P : (n, n) or (N, n, n)
angles : sequence of int
    Which entries of the state are angles.

Returns
-------
float, or (N,)

Raises
------
ValueError
    If shapes do not fit, a number is not finite or a P has no inverse.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.nees([1.0, 2.0], [0.0, 0.0], [[1.0, 0.0], [0.0, 4.0]])
2.0
)");
}

}  // namespace thing_kin::python
