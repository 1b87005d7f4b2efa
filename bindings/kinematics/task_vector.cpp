#include "thing_kin/kinematics/task_vector.hpp"

#include "array.hpp"
#include "bindings.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

void check_base(const Chain& chain) {
  if (!chain.base_joints()) {
    throw InvalidArgument("robot", quoted(chain.name()) + " without a base",
                          "a robot on an omnidirectional base (on_omni_base)");
  }
}

}  // namespace

void bind_task_vector(ChainClass& chain) {
  chain.def(
      "base_pose",
      [](const Chain& c, const ArrayLike& q) {
        check_base(c);
        return map(read_vectors(q, "q", c.dof()), {3}, [&](const double* in, double* out) {
          Eigen::Map<Eigen::Vector3d>{out} = base_pose(c, in);
        });
      },
      py::arg("q"), R"(Planar pose of the base (x, y, theta), as it stands in q, [M17] (3.4).

Parameters
----------
q : (n,) or (N, n), rad and m

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
      [](const Chain& c, const ArrayLike& q) {
        check_base(c);
        return map(read_vectors(q, "q", c.dof()), {10}, [&](const double* in, double* out) {
          Eigen::Map<TaskVector>{out} = task_vector(c, in);
        });
      },
      py::arg("q"), R"(Task vector [p, quaternion w x y z, x, y, theta], [M17] (3.3)-(3.5).

Parameters
----------
q : (n,) or (N, n), rad and m

Returns
-------
(10,) or (N, 10)
    The quaternion has w >= 0.

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
