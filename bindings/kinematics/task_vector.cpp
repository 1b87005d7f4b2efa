#include "thing_kin/kinematics/task_vector.hpp"

#include "bindings.hpp"
#include "map.hpp"
#include "model/chain.hpp"

namespace thing_kin::python {

void bind_task_vector(ChainClass& chain) {
  chain.def(
      "base_pose",
      [](const Chain& c, const ArrayLike& q, const OutArray& out, const ThreadCount& threads) {
        check_omni_base(c);
        return map(read_vectors(q, "q", c.dof()), {3}, {out, threads},
                   [&](const double* in, double* to) {
                     Eigen::Map<Eigen::Vector3d>{to} = base_pose(c, in);
                   });
      },
      py::arg("q"), py::kw_only(), py::arg("out") = py::none(), py::arg("threads") = py::none(),
      R"(Planar pose of the base (x, y, theta), as it stands in q, [M17] (3.4).

Parameters
----------
q : (n,) or (N, n), rad and m
out : (3,) or (N, 3) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(3,) or (N, 3), m and rad
    theta is not wrapped.

Raises
------
ValueError
    If the robot has no omnidirectional base.

Examples
--------
>>> import thing_kin as tk
>>> tk.robots.thing().base_pose([0, 0, 0, 0, 0, 0, 1.0, 2.0, 0.5])
array([1. , 2. , 0.5])
)");
  chain.def(
      "task_vector",
      [](const Chain& c, const ArrayLike& q, const std::string& orientation, const OutArray& out,
         const ThreadCount& threads) {
        const Orientation form = orientation_from_string(orientation);
        check_omni_base(c);
        const Eigen::Index size = 6 + size_of(form);
        return map(read_vectors(q, "q", c.dof()), {size}, {out, threads},
                   [&](const double* in, double* to) {
                     Eigen::Map<Eigen::VectorXd>(to, size) = task_vector(c, in, form);
                   });
      },
      py::arg("q"), py::arg("orientation") = "quaternion", py::kw_only(),
      py::arg("out") = py::none(), py::arg("threads") = py::none(),
      R"(Task vector [p, quaternion w x y z, x, y, theta], [M17] (3.3)-(3.5).

Parameters
----------
q : (n,) or (N, n), rad and m
orientation : str
    'quaternion': w >= 0. 'rpy': roll, pitch, yaw as in transform, in place of the quaternion (not
    in the theses); at a pitch of +-pi/2, where only one combination of roll and yaw is determined,
    roll is 0.
out : (10,), (9,) or batched float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(10,) or (N, 10), with 'rpy' (9,) or (N, 9)

Raises
------
ValueError
    If the robot has no omnidirectional base.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.robots.thing().task_vector(np.zeros(9)).shape
(10,)
)");
}

}  // namespace thing_kin::python
