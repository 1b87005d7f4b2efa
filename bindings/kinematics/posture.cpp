#include "thing_kin/kinematics/posture.hpp"

#include "bindings.hpp"
#include "map.hpp"
#include "model/chain.hpp"
#include "thing_kin/kinematics/batch.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin::python {

namespace {

// One configuration by itself; several side by side.
template <typename WriteOne>
Array poses(const Chain& c, const ArrayLike& q, int frame, std::initializer_list<py::ssize_t> item,
            PoseFormat format, const Run& run, const WriteOne& write_one) {
  Batch batch = read_vectors(q, "q", c.dof());
  const int threads = read_threads(run.threads);
  Array out = make_output(batch, item, run.out);
  double* to = out.mutable_data();
  if (batch.single) {
    write_one(forward_kinematics(c, batch.data, frame), to);
    return out;
  }
  detach(batch, out);
  const py::gil_scoped_release release;
  forward_kinematics(c, {batch.data, static_cast<std::size_t>(batch.count), threads}, frame, format,
                     to);
  return out;
}

void write_position_quaternion(const SE3& T, double* to) {
  Eigen::Map<Eigen::Vector3d>{to} = T.translation;
  Eigen::Map<Eigen::Vector4d>{to + 3} = quaternion_from_rotation(T.rotation);
}

}  // namespace

void bind_posture(ChainClass& chain) {
  chain.def(
      "fk",
      [](const Chain& c, const ArrayLike& q, const FrameLike& frame, const OutArray& out,
         const ThreadCount& threads) {
        return poses(c, q, read_frame(c, frame, "frame"), {4, 4}, PoseFormat::kMatrix,
                     {out, threads}, write_pose);
      },
      py::arg("q"), py::arg("frame") = py::none(), py::kw_only(), py::arg("out") = py::none(),
      py::arg("threads") = py::none(),
      R"(Forward kinematics: pose of a frame, [M17] (3.8).

Parameters
----------
q : (n,) or (N, n), rad and m
frame : str or int, optional
    Name (or index) from `frames`; default: the last, the tool.
out : (4, 4) or (N, 4, 4) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(4, 4) or (N, 4, 4)
    Pose in the root: T maps coordinates in the frame to the world.

Raises
------
ValueError
    If q or out has a wrong shape, q is not finite, or there is no such frame.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.robots.thing().fk(np.zeros(9), frame="mount")[:3, 3]
array([0.27 , 0.01 , 0.653])
)");
  chain.def(
      "fk_quaternion",
      [](const Chain& c, const ArrayLike& q, const FrameLike& frame, const OutArray& out,
         const ThreadCount& threads) {
        return poses(c, q, read_frame(c, frame, "frame"), {7}, PoseFormat::kPositionQuaternion,
                     {out, threads}, write_position_quaternion);
      },
      py::arg("q"), py::arg("frame") = py::none(), py::kw_only(), py::arg("out") = py::none(),
      py::arg("threads") = py::none(),
      R"(Forward kinematics as position and quaternion: less than half the memory of a matrix.

Parameters
----------
q : (n,) or (N, n), rad and m
frame : str or int, optional
    Name (or index) from `frames`; default: the last, the tool.
out : (7,) or (N, 7) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(7,) or (N, 7)
    [x, y, z, qw, qx, qy, qz] in the root, m; unit quaternion with qw >= 0. The first seven numbers
    of task_vector, [M17] (3.3), (3.5).

Raises
------
ValueError
    If q or out has a wrong shape, q is not finite, or there is no such frame.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.robots.thing().fk_quaternion(np.zeros(9), frame="base") + 0.0
array([0., 0., 0., 1., 0., 0., 0.])
)");
  chain.def(
      "fk_all",
      [](const Chain& c, const ArrayLike& q, const OutArray& out, const ThreadCount& threads) {
        const auto count = static_cast<int>(c.frames().size());
        return map(read_vectors(q, "q", c.dof()), {count, 4, 4}, {out, threads},
                   [&](const double* in, double* to) {
                     Posture posture;
                     place_joints(c, in, posture);
                     for (int frame = 0; frame < count; ++frame) {
                       write_pose(frame_pose(c, posture, frame), to + 16 * frame);
                     }
                   });
      },
      py::arg("q"), py::kw_only(), py::arg("out") = py::none(), py::arg("threads") = py::none(),
      R"(Poses of all frames, in the order of `frames`.

Parameters
----------
q : (n,) or (N, n), rad and m
out : (F, 4, 4) or (N, F, 4, 4) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(F, 4, 4) or (N, F, 4, 4)

Raises
------
ValueError
    If q or out has a wrong shape or q is not finite.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.ur5()
>>> robot.fk_all(np.zeros(6)).shape == (len(robot.frames), 4, 4)
True
)");
}

}  // namespace thing_kin::python
