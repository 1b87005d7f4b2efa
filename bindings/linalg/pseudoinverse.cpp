#include "thing_kin/linalg/pseudoinverse.hpp"

#include <optional>

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "map.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/singular_value_filter.hpp"

namespace thing_kin::python {

namespace {

// One lambda for each singular value; zeros if there is no damping.
SmallVector read_damping(const py::object& damping, py::ssize_t count) {
  if (damping.is_none()) {
    return SmallVector::Zero(count);
  }
  const SmallVector lambda = read_number_or_vector(damping, "damping", count, Finite::kYes);
  if (lambda.minCoeff() < 0.0) {
    throw InvalidArgument("damping", text(lambda.minCoeff()), "numbers >= 0");
  }
  return lambda;
}

}  // namespace

void bind_pseudoinverse(py::module_& m) {
  m.def(
      "pinv",
      [](const ArrayLike& J, const py::object& damping,
         const std::optional<SingularValueFilter>& filter) {
        py::ssize_t rows = 0;
        py::ssize_t cols = 0;
        const Batch batch = read_matrices(J, "J", rows, cols);
        const SmallVector lambda = read_damping(damping, std::min(rows, cols));
        const bool exact = lambda.isZero(0.0) && !filter;
        return map(batch, {cols, rows}, [&](const double* in, double* out) {
          const Batch one{in, 1, rows * cols, true, {}};
          const SmallMatrix A = matrix_at(one, 0, rows, cols);
          if (exact) {
            write_matrix(exact_pseudoinverse(A), out);
            return;
          }
          Svd svd;
          decompose(A, svd);
          if (filter) {
            filter->apply(svd);
          }
          write_matrix(pseudoinverse(svd, damped_gains(svd, lambda)), out);
        });
      },
      py::arg("J"), py::kw_only(), py::arg("damping") = py::none(),
      py::arg("singular_value_filter") = py::none(),
      R"(Pseudoinverse of a matrix: exact, damped or selectively damped.

Exact, [M17] (4.9): singular values up to max(m, n) eps sigma_1 count as zero. Damped, (4.10):
sigma/(sigma^2 + lambda), which is J^T (J J^T + lambda I)^-1 of (4.7). Selectively damped in matrix
form, (4.11): one lambda for each singular value, largest first. For the step of Buss & Kim, which
chooses them by the error, see selectively_damped_step.

Parameters
----------
J : (m, n) or (N, m, n), at most 32 on a side
damping : float or (min(m, n),), >= 0, optional
    lambda. Note: lambda itself, not its square.
singular_value_filter : SingularValueFilter, optional
    Applied to the singular values first.

Returns
-------
(n, m) or (N, n, m)

Raises
------
ValueError
    If J or damping has a wrong shape, is not finite or damping is negative.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.pinv(np.array([[2.0, 0.0], [0.0, 0.0]]))
array([[0.5, 0. ],
       [0. , 0. ]])
>>> tk.pinv(np.array([[2.0, 0.0], [0.0, 0.0]]), damping=1.0)
array([[0.4, 0. ],
       [0. , 0. ]])
)");
}

}  // namespace thing_kin::python
