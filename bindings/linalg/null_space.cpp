#include "thing_kin/linalg/null_space.hpp"

#include "bindings.hpp"
#include "map.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

void bind_null_space(py::module_& m) {
  m.def(
      "null_space",
      [](const ArrayLike& J) {
        py::ssize_t rows = 0;
        py::ssize_t cols = 0;
        const Batch batch = read_matrices(J, "J", rows, cols);
        if (!batch.single) {
          throw InvalidArgument("J", "a batch", "shape (m, n): null spaces differ in size");
        }
        const SmallMatrix Z = null_space(matrix_at(batch, 0, rows, cols));
        const py::ssize_t shape[] = {Z.rows(), Z.cols()};
        Array out = make_array(shape, 2);
        write_matrix(Z, out.mutable_data());
        return out;
      },
      py::arg("J"), R"(Orthonormal basis of the null space of a matrix.

Singular values up to max(m, n) eps sigma_1 count as zero.

Parameters
----------
J : (m, n), at most 32 on a side

Returns
-------
(n, n - rank)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> abs(tk.null_space(np.array([[1.0, 0.0]])))
array([[0.],
       [1.]])
)");
  m.def(
      "null_space_projector",
      [](const ArrayLike& J) {
        py::ssize_t rows = 0;
        py::ssize_t cols = 0;
        const Batch batch = read_matrices(J, "J", rows, cols);
        return map(batch, {cols, cols}, [&](const double* in, double* out) {
          const Batch one{in, 1, rows * cols, true, {}};
          write_matrix(null_space_projector(matrix_at(one, 0, rows, cols)), out);
        });
      },
      py::arg("J"), R"(The exact orthogonal projector I - J^+ J onto the null space, [M17] (4.15).

Built from the null space itself: I - J# J with a damped or filtered inverse is no projector.

Parameters
----------
J : (m, n) or (N, m, n), at most 32 on a side

Returns
-------
(n, n) or (N, n, n)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.null_space_projector(np.array([[1.0, 0.0]])) + 0.0
array([[0., 0.],
       [0., 1.]])
)");
}

}  // namespace thing_kin::python
