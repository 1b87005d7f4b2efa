#include "thing_kin/lie/so3.hpp"

#include <cmath>

#include "bindings.hpp"
#include "map.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Map3 = Eigen::Map<const Eigen::Vector3d>;

void check_rotations(const Batch& batch, const char* name) {
  for (py::ssize_t i = 0; i < batch.count; ++i) {
    read_rotation(batch.item(i), name);
  }
}

Array matrix_of_vector(const ArrayLike& phi, Eigen::Matrix3d (*function)(const Eigen::Vector3d&)) {
  const Batch batch = read(phi, "phi", {3});
  check_magnitude(batch, "phi");
  return map(batch, {3, 3},
             [&](const double* in, double* out) { write_matrix(function(Map3(in)), out); });
}

Array inverse_of_vector(const ArrayLike& phi, Eigen::Matrix3d (*function)(const Eigen::Vector3d&)) {
  const Batch batch = read(phi, "phi", {3});
  check_magnitude(batch, "phi");
  for (py::ssize_t i = 0; i < batch.count; ++i) {
    const double turns = Map3(batch.item(i)).norm() / (2 * M_PI);
    if (turns > 0.5 && std::abs(turns - std::round(turns)) < 1e-9) {
      throw InvalidArgument("phi", "a rotation by a whole number of turns",
                            "a norm away from 2 pi k, where the Jacobian is singular");
    }
  }
  return matrix_of_vector(phi, function);
}

}  // namespace

void bind_so3(py::module_& lie) {
  lie.def(
      "so3_exp", [](const ArrayLike& phi) { return matrix_of_vector(phi, so3_exp); },
      py::arg("phi"), R"(Rotation matrix of a rotation vector (Rodrigues).

Parameters
----------
phi : (3,) or (N, 3), rad

Returns
-------
(3, 3) or (N, 3, 3)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.lie.so3_exp([0, 0, np.pi / 2]).round(12) + 0.0
array([[ 0., -1.,  0.],
       [ 1.,  0.,  0.],
       [ 0.,  0.,  1.]])
)");
  lie.def(
      "so3_log",
      [](const ArrayLike& R) {
        const Batch batch = read(R, "R", {3, 3});
        check_rotations(batch, "R");
        return map(batch, {3}, [](const double* in, double* out) {
          Eigen::Map<Eigen::Vector3d>{out} = so3_log(Eigen::Map<const RowMajor3>(in));
        });
      },
      py::arg("R"), R"(Rotation vector of a rotation matrix, its norm in [0, pi], [M17] (4.28).

Exact to rounding everywhere. At pi both signs of the axis are right: the first nonzero component
is positive.

Parameters
----------
R : (3, 3) or (N, 3, 3)

Returns
-------
(3,) or (N, 3), rad

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.lie.so3_log(np.diag([-1.0, -1.0, 1.0]))  # half a turn about z
array([0.        , 0.        , 3.14159265])
)");
  lie.def(
      "so3_left_jacobian",
      [](const ArrayLike& phi) { return matrix_of_vector(phi, so3_left_jacobian); }, py::arg("phi"),
      R"(Left Jacobian J: exp(phi + d) = exp(J d) exp(phi) to first order in d.

Parameters
----------
phi : (3,) or (N, 3), rad

Returns
-------
(3, 3) or (N, 3, 3)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.lie.so3_left_jacobian(np.zeros(3))
array([[1., 0., 0.],
       [0., 1., 0.],
       [0., 0., 1.]])
)");
  lie.def(
      "so3_right_jacobian",
      [](const ArrayLike& phi) { return matrix_of_vector(phi, so3_right_jacobian); },
      py::arg("phi"), R"(Right Jacobian J: exp(phi + d) = exp(phi) exp(J d) to first order in d.

Parameters
----------
phi : (3,) or (N, 3), rad

Returns
-------
(3, 3) or (N, 3, 3)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> phi = np.array([0.1, -0.2, 0.3])
>>> np.allclose(tk.lie.so3_right_jacobian(phi), tk.lie.so3_left_jacobian(-phi))
True
)");
  lie.def(
      "so3_left_jacobian_inverse",
      [](const ArrayLike& phi) { return inverse_of_vector(phi, so3_left_jacobian_inverse); },
      py::arg("phi"), R"(Inverse of the left Jacobian.

Parameters
----------
phi : (3,) or (N, 3), rad

Returns
-------
(3, 3) or (N, 3, 3)

Raises
------
ValueError
    If phi is a whole number of turns, where the Jacobian is singular.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> phi = [0.1, -0.2, 0.3]
>>> J = tk.lie.so3_left_jacobian(phi)
>>> np.allclose(tk.lie.so3_left_jacobian_inverse(phi) @ J, np.eye(3))
True
)");
  lie.def(
      "so3_right_jacobian_inverse",
      [](const ArrayLike& phi) { return inverse_of_vector(phi, so3_right_jacobian_inverse); },
      py::arg("phi"), R"(Inverse of the right Jacobian.

Parameters
----------
phi : (3,) or (N, 3), rad

Returns
-------
(3, 3) or (N, 3, 3)

Raises
------
ValueError
    If phi is a whole number of turns, where the Jacobian is singular.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> phi = [0.1, -0.2, 0.3]
>>> J = tk.lie.so3_right_jacobian(phi)
>>> np.allclose(tk.lie.so3_right_jacobian_inverse(phi) @ J, np.eye(3))
True
)");
  lie.def(
      "quaternion_from_rotation",
      [](const ArrayLike& R) {
        const Batch batch = read(R, "R", {3, 3});
        check_rotations(batch, "R");
        return map(batch, {4}, [](const double* in, double* out) {
          Eigen::Map<Eigen::Vector4d>{out} =
              quaternion_from_rotation(Eigen::Map<const RowMajor3>(in));
        });
      },
      py::arg("R"), R"(Unit quaternion (w, x, y, z) of a rotation matrix, with w >= 0.

At w = 0 the first nonzero component is positive.

Parameters
----------
R : (3, 3) or (N, 3, 3)

Returns
-------
(4,) or (N, 4)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.lie.quaternion_from_rotation(np.eye(3))
array([1., 0., 0., 0.])
)");
  lie.def(
      "rotation_from_quaternion",
      [](const ArrayLike& q) {
        const Batch batch = read(q, "quaternion", {4});
        for (py::ssize_t i = 0; i < batch.count; ++i) {
          if (Eigen::Map<const Eigen::Vector4d>(batch.item(i)).isZero(0.0)) {
            throw InvalidArgument("quaternion", "zero",
                                  "a quaternion (w, x, y, z) that is not zero");
          }
        }
        return map(batch, {3, 3}, [](const double* in, double* out) {
          write_matrix(rotation_from_quaternion(Eigen::Map<const Eigen::Vector4d>(in)), out);
        });
      },
      py::arg("quaternion"), R"(Rotation matrix of a quaternion (w, x, y, z), normalized first.

Parameters
----------
quaternion : (4,) or (N, 4)

Returns
-------
(3, 3) or (N, 3, 3)

Raises
------
ValueError
    If the quaternion is zero.

Examples
--------
>>> import thing_kin as tk
>>> tk.lie.rotation_from_quaternion([0, 0, 0, 1])  # half a turn about z
array([[-1.,  0.,  0.],
       [ 0., -1.,  0.],
       [ 0.,  0.,  1.]])
)");
  lie.def(
      "rpy_from_rotation",
      [](const ArrayLike& R) {
        const Batch batch = read(R, "R", {3, 3});
        check_rotations(batch, "R");
        return map(batch, {3}, [](const double* in, double* out) {
          Eigen::Map<Eigen::Vector3d>{out} = rpy_from_rotation(Eigen::Map<const RowMajor3>(in));
        });
      },
      py::arg("R"), R"(Roll, pitch, yaw of a rotation matrix: R = Rz(yaw) Ry(pitch) Rx(roll).

The pitch is in [-pi/2, pi/2]. At either end, where only yaw - roll or yaw + roll is determined,
roll is 0. The three give R back to rounding everywhere.

Parameters
----------
R : (3, 3) or (N, 3, 3)

Returns
-------
(3,) or (N, 3), rad

Examples
--------
>>> import thing_kin as tk
>>> tk.lie.rpy_from_rotation(tk.transform(rpy=(0.1, 0.2, 0.3))[:3, :3])
array([0.1, 0.2, 0.3])
)");
  lie.def(
      "rotation_from_rpy",
      [](const ArrayLike& rpy) {
        return map(read(rpy, "rpy", {3}), {3, 3}, [](const double* in, double* out) {
          write_matrix(rotation_from_rpy(Map3(in)), out);
        });
      },
      py::arg("rpy"), R"(Rotation matrix Rz(yaw) Ry(pitch) Rx(roll), as in URDF.

Parameters
----------
rpy : (3,) or (N, 3), rad
    Roll, pitch, yaw.

Returns
-------
(3, 3) or (N, 3, 3)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> R = tk.lie.rotation_from_rpy([0.1, 0.2, 0.3])
>>> np.array_equal(R, tk.transform(rpy=(0.1, 0.2, 0.3))[:3, :3])
True
)");
}

}  // namespace thing_kin::python
