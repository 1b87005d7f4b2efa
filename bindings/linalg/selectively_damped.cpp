#include "thing_kin/linalg/selectively_damped.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include <pybind11/stl.h>

#include "array.hpp"
#include "bindings.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/singular_value_filter.hpp"

namespace thing_kin::python {

namespace {

RowBlocks read_blocks(const std::optional<std::vector<int>>& sizes, py::ssize_t rows) {
  if (!sizes) {
    return rows == 6 ? RowBlocks::pose() : RowBlocks::whole(static_cast<int>(rows));
  }
  RowBlocks blocks;
  py::ssize_t sum = 0;
  for (const int size : *sizes) {
    if (size < 1 || sum + size > rows) {
      throw InvalidArgument("blocks", std::string(py::str(py::cast(*sizes))),
                            "positive sizes that add up to " + std::to_string(rows));
    }
    sum += size;
    blocks.size[static_cast<std::size_t>(blocks.count++)] = size;
  }
  if (sum != rows) {
    throw InvalidArgument("blocks", std::string(py::str(py::cast(*sizes))),
                          "positive sizes that add up to " + std::to_string(rows));
  }
  return blocks;
}

}  // namespace

void bind_selectively_damped(py::module_& m) {
  m.def(
      "selectively_damped_step",
      [](const ArrayLike& J, const ArrayLike& e, double gamma_max,
         const std::optional<std::vector<int>>& blocks,
         const std::optional<SingularValueFilter>& filter) {
        py::ssize_t rows = 0;
        py::ssize_t cols = 0;
        const Batch matrix = read_matrices(J, "J", rows, cols);
        if (!matrix.single) {
          throw InvalidArgument("J", "a batch", "shape (m, n)");
        }
        const Batch error = read(e, "e", {rows}, false);
        if (!(std::isfinite(gamma_max) && gamma_max > 0.0)) {
          throw InvalidArgument("gamma_max", text(gamma_max), "a finite number > 0");
        }
        const RowBlocks row_blocks = read_blocks(blocks, rows);
        Svd svd;
        decompose(matrix_at(matrix, 0, rows, cols), svd);
        if (filter) {
          filter->apply(svd);
        }
        const JointVector step =
            selectively_damped_step(svd, row_blocks, vector_at(error, 0), gamma_max);
        return Array(step.size(), step.data());
      },
      py::arg("J"), py::arg("e"), py::arg("gamma_max") = std::numbers::pi / 4, py::kw_only(),
      py::arg("blocks") = py::none(), py::arg("singular_value_filter") = py::none(),
      R"(Selectively damped least-squares step for J dq = e, [M17] (4.11), Buss & Kim (2005).

Each singular direction is clamped by how much it would move the joints for what it moves the task.

Parameters
----------
J : (m, n), at most 32 on a side
e : (m,)
gamma_max : float, rad (m for prismatic joints)
    Largest absolute entry of the step.
blocks : sequence of int, optional
    Rows of each end-effector block. Default: (3, 3), linear and angular, for six rows, else one.
singular_value_filter : SingularValueFilter, optional
    Applied to the singular values first.

Returns
-------
(n,)

Raises
------
ValueError
    If a shape does not fit, a number is not finite or gamma_max is not positive.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> nearly_singular = np.diag([1.0, 1e-9])  # its pseudoinverse would ask for 1e8
>>> tk.selectively_damped_step(nearly_singular, [0.1, 0.1], gamma_max=0.5)
array([0.1, 0.5])
)");
}

}  // namespace thing_kin::python
