#include "thing_kin/kinematics/posture.hpp"

#include "array.hpp"
#include "bindings.hpp"
#include "model/chain.hpp"

namespace thing_kin::python {

void bind_posture(ChainClass& chain) {
  chain.def(
      "fk",
      [](const Chain& c, const ArrayLike& q, const py::object& frame) {
        const int index = read_frame(c, frame, "frame");
        return map(read_vectors(q, "q", c.dof()), {4, 4}, [&](const double* in, double* out) {
          write_pose(forward_kinematics(c, in, index), out);
        });
      },
      py::arg("q"), py::arg("frame") = py::none(),
      R"(Forward kinematics: pose of a frame, [M17] (3.8).

Parameters
----------
q : (n,) or (N, n), rad and m
frame : str or int, optional
    Name (or index) from `frames`; default: the last, the tool.

Returns
-------
(4, 4) or (N, 4, 4)
    Pose in the root: T maps coordinates in the frame to the world.

Raises
------
ValueError
    If q has a wrong shape or is not finite, or there is no such frame.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.robots.thing().fk(np.zeros(9), frame="mount")[:3, 3]
array([0.27 , 0.01 , 0.653])
)");
  chain.def(
      "fk_all",
      [](const Chain& c, const ArrayLike& q) {
        const auto count = static_cast<int>(c.frames().size());
        return map(read_vectors(q, "q", c.dof()), {count, 4, 4},
                   [&](const double* in, double* out) {
                     Posture posture;
                     place_joints(c, in, posture);
                     for (int frame = 0; frame < count; ++frame) {
                       write_pose(frame_pose(c, posture, frame), out + 16 * frame);
                     }
                   });
      },
      py::arg("q"), R"(Poses of all frames, in the order of `frames`.

Parameters
----------
q : (n,) or (N, n), rad and m

Returns
-------
(F, 4, 4) or (N, F, 4, 4)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.ur5()
>>> robot.fk_all(np.zeros(6)).shape == (len(robot.frames), 4, 4)
True
)");
}

}  // namespace thing_kin::python
