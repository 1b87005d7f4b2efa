#include "thing_kin/lie/se3.hpp"

#include <cmath>

#include "bindings.hpp"
#include "map.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin::python {

namespace {

using Map6 = Eigen::Map<const Vector6>;

Batch read_twists(const ArrayLike& xi) {
  Batch batch = read(xi, "xi", {6});
  check_magnitude(batch, "xi");
  return batch;
}

Array matrix_of_twist(const ArrayLike& xi, Matrix6 (*function)(const Vector6&)) {
  return map(read_twists(xi), {6, 6},
             [&](const double* in, double* out) { write_matrix(function(Map6(in)), out); });
}

Array inverse_of_twist(const ArrayLike& xi, Matrix6 (*function)(const Vector6&)) {
  const Batch batch = read_twists(xi);
  for (py::ssize_t i = 0; i < batch.count; ++i) {
    const double turns = Map6(batch.item(i)).tail<3>().norm() / (2 * M_PI);
    if (turns > 0.5 && std::abs(turns - std::round(turns)) < 1e-9) {
      throw InvalidArgument("xi", "a rotation by a whole number of turns",
                            "an angular norm away from 2 pi k, where the Jacobian is singular");
    }
  }
  return matrix_of_twist(xi, function);
}

Batch read_poses(const ArrayLike& T) {
  Batch batch = read(T, "T", {4, 4});
  for (py::ssize_t i = 0; i < batch.count; ++i) {
    read_pose(batch.item(i), "T");
  }
  return batch;
}

Eigen::Matrix3d rotation_of(const py::object& rpy, const py::object& quaternion) {
  if (!rpy.is_none() && !quaternion.is_none()) {
    throw InvalidArgument("rpy, quaternion", "both", "at most one of them");
  }
  if (!quaternion.is_none()) {
    const Batch q = read(quaternion, "quaternion", {4}, false);
    const Eigen::Vector4d wxyz = vector_at(q, 0);
    if (wxyz.isZero(0.0)) {
      throw InvalidArgument("quaternion", "zero", "a quaternion (w, x, y, z) that is not zero");
    }
    return rotation_from_quaternion(wxyz);
  }
  if (!rpy.is_none()) {
    const Batch angles = read(rpy, "rpy", {3}, false);
    return rotation_from_rpy(vector_at(angles, 0));
  }
  return Eigen::Matrix3d::Identity();
}

}  // namespace

void bind_se3(py::module_& lie, py::module_& top) {
  lie.def("as_matrix", &as_matrix, py::arg("argument"),
          "Matrix of a pose or rotation as another library has it; anything else as it is.");
  top.def(
      "transform",
      [](const ArrayLike& xyz, const py::object& rpy, const py::object& quaternion) {
        const Batch p = read(xyz, "xyz", {3}, false);
        const SE3 T{rotation_of(rpy, quaternion), vector_at(p, 0)};
        const py::ssize_t shape[] = {4, 4};
        Array out = make_array(shape, 2);
        write_pose(T, out.mutable_data());
        return out;
      },
      py::arg("xyz") = py::make_tuple(0.0, 0.0, 0.0), py::arg("rpy") = py::none(),
      py::arg("quaternion") = py::none(), R"(Homogeneous matrix of a position and an orientation.

Parameters
----------
xyz : (3,), m
rpy : (3,), rad, optional
    Roll, pitch, yaw as in URDF: R = Rz(yaw) Ry(pitch) Rx(roll).
quaternion : (4,), optional
    (w, x, y, z), instead of rpy.

Returns
-------
(4, 4)

Raises
------
ValueError
    If both rpy and quaternion are given, or one is malformed.

Examples
--------
>>> import thing_kin as tk
>>> tk.transform(xyz=(1, 2, 3))
array([[1., 0., 0., 1.],
       [0., 1., 0., 2.],
       [0., 0., 1., 3.],
       [0., 0., 0., 1.]])
)");
  lie.def(
      "se3_exp",
      [](const ArrayLike& xi) {
        return map(read_twists(xi), {4, 4},
                   [](const double* in, double* out) { write_pose(se3_exp(Map6(in)), out); });
      },
      py::arg("xi"), R"(Rigid transform of a twist [linear, angular].

Parameters
----------
xi : (6,) or (N, 6), m and rad

Returns
-------
(4, 4) or (N, 4, 4)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> xi = np.array([1.0, 2.0, 3.0, 0.1, 0.2, 0.3])
>>> np.allclose(tk.lie.se3_log(tk.lie.se3_exp(xi)), xi)
True
)");
  lie.def(
      "se3_log",
      [](const ArrayLike& T) {
        return map(read_poses(T), {6}, [](const double* in, double* out) {
          Eigen::Map<Vector6>{out} = se3_log(read_pose(in, "T"));
        });
      },
      py::arg("T"), R"(Twist [linear, angular] of a rigid transform, its angle in [0, pi].

Parameters
----------
T : (4, 4) or (N, 4, 4)

Returns
-------
(6,) or (N, 6), m and rad

Examples
--------
>>> import thing_kin as tk
>>> tk.lie.se3_log(tk.transform(xyz=(1, 2, 3)))
array([1., 2., 3., 0., 0., 0.])
)");
  lie.def(
      "se3_adjoint",
      [](const ArrayLike& T) {
        return map(read_poses(T), {6, 6}, [](const double* in, double* out) {
          write_matrix(se3_adjoint(read_pose(in, "T")), out);
        });
      },
      py::arg("T"), R"(Adjoint of T_a_b: takes a twist [linear, angular] in b to the same in a.

Parameters
----------
T : (4, 4) or (N, 4, 4)

Returns
-------
(6, 6) or (N, 6, 6)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> T, xi = tk.transform(xyz=(1, 0, 0), rpy=(0, 0, 1)), [0, 0, 0, 0, 0, 0.5]
>>> moved = T @ tk.lie.se3_exp(xi) @ np.linalg.inv(T)
>>> np.allclose(moved, tk.lie.se3_exp(tk.lie.se3_adjoint(T) @ xi))
True
)");
  lie.def(
      "se3_left_jacobian",
      [](const ArrayLike& xi) { return matrix_of_twist(xi, se3_left_jacobian); }, py::arg("xi"),
      R"(Left Jacobian J: exp(xi + d) = exp(J d) exp(xi) to first order in d.

Parameters
----------
xi : (6,) or (N, 6), m and rad

Returns
-------
(6, 6) or (N, 6, 6)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> np.array_equal(tk.lie.se3_left_jacobian(np.zeros(6)), np.eye(6))
True
)");
  lie.def(
      "se3_right_jacobian",
      [](const ArrayLike& xi) { return matrix_of_twist(xi, se3_right_jacobian); }, py::arg("xi"),
      R"(Right Jacobian J: exp(xi + d) = exp(xi) exp(J d) to first order in d.

Parameters
----------
xi : (6,) or (N, 6), m and rad

Returns
-------
(6, 6) or (N, 6, 6)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> np.array_equal(tk.lie.se3_right_jacobian(np.zeros(6)), np.eye(6))
True
)");
  lie.def(
      "se3_left_jacobian_inverse",
      [](const ArrayLike& xi) { return inverse_of_twist(xi, se3_left_jacobian_inverse); },
      py::arg("xi"), R"(Inverse of the left Jacobian.

Parameters
----------
xi : (6,) or (N, 6), m and rad

Returns
-------
(6, 6) or (N, 6, 6)

Raises
------
ValueError
    If the angular part is a whole number of turns, where the Jacobian is singular.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> xi = [1.0, 2.0, 3.0, 0.1, 0.2, 0.3]
>>> J = tk.lie.se3_left_jacobian(xi)
>>> np.allclose(tk.lie.se3_left_jacobian_inverse(xi) @ J, np.eye(6))
True
)");
  lie.def(
      "se3_right_jacobian_inverse",
      [](const ArrayLike& xi) { return inverse_of_twist(xi, se3_right_jacobian_inverse); },
      py::arg("xi"), R"(Inverse of the right Jacobian.

Parameters
----------
xi : (6,) or (N, 6), m and rad

Returns
-------
(6, 6) or (N, 6, 6)

Raises
------
ValueError
    If the angular part is a whole number of turns, where the Jacobian is singular.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> xi = [1.0, 2.0, 3.0, 0.1, 0.2, 0.3]
>>> J = tk.lie.se3_right_jacobian(xi)
>>> np.allclose(tk.lie.se3_right_jacobian_inverse(xi) @ J, np.eye(6))
True
)");
}

}  // namespace thing_kin::python
