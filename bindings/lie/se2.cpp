#include "thing_kin/lie/se2.hpp"

#include <cmath>
#include <numbers>

#include "bindings.hpp"
#include "map.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

using Map3 = Eigen::Map<const Eigen::Vector3d>;

Batch read_triples(const ArrayLike& argument, const char* name) {
  Batch batch = read_vectors(argument, name, 3);
  check_magnitude(batch, name);
  return batch;
}

Array vector_map(const Batch& batch, Eigen::Vector3d (*function)(const Eigen::Vector3d&)) {
  return map(batch, {3}, [&](const double* in, double* out) {
    Eigen::Map<Eigen::Vector3d>{out} = function(Map3(in));
  });
}

Array matrix_map(const Batch& batch, Eigen::Matrix3d (*function)(const Eigen::Vector3d&)) {
  return map(batch, {3, 3},
             [&](const double* in, double* out) { write_matrix(function(Map3(in)), out); });
}

Array inverse_map(const ArrayLike& xi, Eigen::Matrix3d (*function)(const Eigen::Vector3d&)) {
  const Batch batch = read_triples(xi, "xi");
  for (py::ssize_t i = 0; i < batch.count; ++i) {
    const double turns = std::abs(batch.item(i)[2]) / (2.0 * std::numbers::pi);
    if (turns > 0.5 && std::abs(turns - std::round(turns)) < 1e-9) {
      throw InvalidArgument("xi", "a rotation by a whole number of turns",
                            "an omega away from 2 pi k, where the Jacobian is singular");
    }
  }
  return matrix_map(batch, function);
}

Array pair_map(const ArrayLike& first, const char* first_name, const ArrayLike& second,
               const char* second_name,
               Eigen::Vector3d (*function)(const Eigen::Vector3d&, const Eigen::Vector3d&)) {
  Batches<2> both{read_triples(first, first_name), read_triples(second, second_name)};
  if (!both[0].single && !both[1].single && both[0].count != both[1].count) {
    throw InvalidArgument(
        second_name, std::to_string(both[1].count) + " poses",
        std::to_string(both[0].count) + ", as many as " + first_name + ", or one");
  }
  const Serial serial;
  return map_together(both, {3}, Run{serial.out, serial.threads},
                      [&](const std::array<const double*, 2>& in, double* out) {
                        Eigen::Map<Eigen::Vector3d>{out} = function(Map3(in[0]), Map3(in[1]));
                      });
}

void bind_se2_group(py::module_& lie) {
  lie.def(
      "se2_compose",
      [](const ArrayLike& a, const ArrayLike& b) { return pair_map(a, "a", b, "b", compose); },
      py::arg("a"), py::arg("b"), R"(Planar pose T_w_b of T_w_a and T_a_b.

Parameters
----------
a, b : (3,) or (N, 3), m and rad
    (x, y, theta).

Returns
-------
(3,) or (N, 3), theta in (-pi, pi]

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.lie.se2_compose([1.0, 0.0, np.pi / 2], [1.0, 0.0, 0.0]).round(3)
array([1.   , 1.   , 1.571])
)");
  lie.def(
      "se2_inverse",
      [](const ArrayLike& pose) { return vector_map(read_triples(pose, "pose"), inverse); },
      py::arg("pose"), R"(Planar pose T_b_a of T_a_b.

Parameters
----------
pose : (3,) or (N, 3), m and rad

Returns
-------
(3,) or (N, 3), theta in (-pi, pi]

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.lie.se2_inverse([1.0, 0.0, np.pi / 2]).round(3)
array([-0.   ,  1.   , -1.571])
)");
  lie.def(
      "se2_between",
      [](const ArrayLike& a, const ArrayLike& b) { return pair_map(a, "a", b, "b", between); },
      py::arg("a"), py::arg("b"), R"(Planar pose T_a_b of T_w_a and T_w_b: b as a sees it.

Parameters
----------
a, b : (3,) or (N, 3), m and rad

Returns
-------
(3,) or (N, 3), theta in (-pi, pi]

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.lie.se2_between([1.0, 0.0, np.pi / 2], [1.0, 1.0, np.pi / 2]).round(3)
array([1., 0., 0.])
)");
}

}  // namespace

void bind_se2(py::module_& lie) {
  bind_se2_group(lie);
  lie.def(
      "se2_exp", [](const ArrayLike& xi) { return vector_map(read_triples(xi, "xi"), se2_exp); },
      py::arg("xi"),
      R"(Planar pose of a twist (vx, vy, omega) held for one second.

Parameters
----------
xi : (3,) or (N, 3), m and rad

Returns
-------
(3,) or (N, 3), m and rad
    (x, y, theta), theta in (-pi, pi].

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> np.allclose(tk.lie.se2_exp([np.pi / 2, 0.0, np.pi / 2]), [1.0, 1.0, np.pi / 2])
True
)");
  lie.def(
      "se2_log",
      [](const ArrayLike& pose) { return vector_map(read_triples(pose, "pose"), se2_log); },
      py::arg("pose"),
      R"(Twist (vx, vy, omega) of a planar pose, omega in (-pi, pi].

Parameters
----------
pose : (3,) or (N, 3), m and rad

Returns
-------
(3,) or (N, 3), m and rad

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> xi = np.array([1.0, 2.0, 0.5])
>>> np.allclose(tk.lie.se2_log(tk.lie.se2_exp(xi)), xi)
True
)");
  lie.def(
      "se2_adjoint",
      [](const ArrayLike& pose) { return matrix_map(read_triples(pose, "pose"), se2_adjoint); },
      py::arg("pose"),
      R"(Adjoint of T_a_b: takes a twist (vx, vy, omega) in b to the same in a.

Parameters
----------
pose : (3,) or (N, 3), m and rad

Returns
-------
(3, 3) or (N, 3, 3)

Examples
--------
>>> import thing_kin as tk
>>> tk.lie.se2_adjoint([1.0, 2.0, 0.0])
array([[ 1., -0.,  2.],
       [ 0.,  1., -1.],
       [ 0.,  0.,  1.]])
)");
  lie.def(
      "se2_left_jacobian",
      [](const ArrayLike& xi) { return matrix_map(read_triples(xi, "xi"), se2_left_jacobian); },
      py::arg("xi"),
      R"(Left Jacobian J: exp(xi + d) = exp(J d) exp(xi) to first order in d.

Parameters
----------
xi : (3,) or (N, 3), m and rad

Returns
-------
(3, 3) or (N, 3, 3)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> np.array_equal(tk.lie.se2_left_jacobian(np.zeros(3)), np.eye(3))
True
)");
  lie.def(
      "se2_left_jacobian_inverse",
      [](const ArrayLike& xi) { return inverse_map(xi, se2_left_jacobian_inverse); }, py::arg("xi"),
      R"(Inverse of the left Jacobian.

Parameters
----------
xi : (3,) or (N, 3), m and rad

Returns
-------
(3, 3) or (N, 3, 3)

Raises
------
ValueError
    If omega is a whole number of turns, where the Jacobian is singular.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> xi = [1.0, 2.0, 0.5]
>>> J = tk.lie.se2_left_jacobian(xi)
>>> np.allclose(tk.lie.se2_left_jacobian_inverse(xi) @ J, np.eye(3))
True
)");
  lie.def(
      "se2_right_jacobian",
      [](const ArrayLike& xi) { return matrix_map(read_triples(xi, "xi"), se2_right_jacobian); },
      py::arg("xi"),
      R"(Right Jacobian J: exp(xi + d) = exp(xi) exp(J d) to first order in d.

Parameters
----------
xi : (3,) or (N, 3), m and rad

Returns
-------
(3, 3) or (N, 3, 3)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> np.array_equal(tk.lie.se2_right_jacobian(np.zeros(3)), np.eye(3))
True
)");
  lie.def(
      "se2_right_jacobian_inverse",
      [](const ArrayLike& xi) { return inverse_map(xi, se2_right_jacobian_inverse); },
      py::arg("xi"),
      R"(Inverse of the right Jacobian.

Parameters
----------
xi : (3,) or (N, 3), m and rad

Returns
-------
(3, 3) or (N, 3, 3)

Raises
------
ValueError
    If omega is a whole number of turns, where the Jacobian is singular.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> xi = [1.0, 2.0, 0.5]
>>> J = tk.lie.se2_right_jacobian(xi)
>>> np.allclose(tk.lie.se2_right_jacobian_inverse(xi) @ J, np.eye(3))
True
)");
}

}  // namespace thing_kin::python
