#include "thing_kin/kinematics/analytic_jacobian.hpp"

#include "bindings.hpp"
#include "kinematics/motion.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin::python {

namespace {

[[noreturn]] void throw_gimbal_lock(const Chain& c, const Posture& posture, int frame,
                                    const Batch& q, const double* item) {
  const double pitch = rpy_from_rotation(frame_pose(c, posture, frame).rotation)[1];
  std::string got = "a pitch of " + text(pitch) + " rad of frame " +
                    quoted(c.frames()[static_cast<std::size_t>(frame)].name);
  if (!q.single) {
    got.append(" in item ").append(std::to_string((item - q.data) / q.size));
  }
  throw InvalidArgument("q", got,
                        "one away from +-pi/2, where roll and yaw have no rates "
                        "(orientation='quaternion' has them everywhere)");
}

template <typename Fill>
Array derivative(const Chain& c, const ArrayLike& q, int frame, py::ssize_t rows, const Run& run,
                 Fill fill) {
  Batches<1> batch = {read_vectors(q, "q", c.dof())};
  return map_together(batch, {rows, c.dof()}, run, [&](const auto& in, double* out) {
    Posture posture;
    AnalyticJacobian J;
    place_joints(c, in[0], posture);
    if (!fill(posture, J)) {
      throw_gimbal_lock(c, posture, frame, batch[0], in[0]);
    }
    write_matrix(J, out);
  });
}

}  // namespace

void bind_analytic_jacobian(ChainClass& chain) {
  chain.def(
      "analytic_jacobian",
      [](const Chain& c, const ArrayLike& q, const std::string& orientation, const FrameLike& of,
         const PointLike& point, const OutArray& out, const ThreadCount& threads) {
        const Orientation form = orientation_from_string(orientation);
        const MovingPoint moving = read_point(c, of, point);
        return derivative(c, q, moving.frame, 3 + size_of(form), {out, threads},
                          [&](const Posture& posture, AnalyticJacobian& J) {
                            return analytic_jacobian(c, posture, moving, form, J);
                          });
      },
      py::arg("q"), py::arg("orientation") = "quaternion", py::arg("of") = py::none(),
      py::arg("point") = py::none(), py::kw_only(), py::arg("out") = py::none(),
      py::arg("threads") = py::none(),
      R"(Derivative of position and orientation in coordinates: d[p, orientation]/dq.

The geometric Jacobian's angular rows are a velocity, the derivative of no coordinates; these are
derivatives of numbers, [M17] (3.9) of (3.3), as (3.10) and (3.11) need them.

Parameters
----------
q : (n,) or (N, n), rad and m
orientation : str
    'quaternion': (w, x, y, z) with w >= 0, as in task_vector. At w = 0, where it jumps to its
    opposite, the derivative is that of the branch taken. 'rpy': roll, pitch, yaw as in transform.
of, point
    As for jacobian; p is the position of the point.
out : (7, n), (6, n) or batched float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(7, n) or (6, n), or a batch (N, 7, n) or (N, 6, n)

Raises
------
ValueError
    With 'rpy' at a pitch within 1e-9 rad of +-pi/2, where roll and yaw have no rates: which, and
    in which item of a batch (what `out` holds is undefined then). If q or point has a wrong shape or is not finite, or there is no such
    frame.

Examples
--------
>>> import thing_kin as tk
>>> arm = tk.Chain.from_dh([tk.DH(a=2.0, joint="revolute")])
>>> arm.analytic_jacobian([0.0])[:, 0] + 0.0
array([0. , 2. , 0. , 0. , 0. , 0. , 0.5])
>>> arm.analytic_jacobian([0.0], orientation="rpy")[:, 0]
array([0., 2., 0., 0., 0., 1.])
)");
  chain.def(
      "task_jacobian",
      [](const Chain& c, const ArrayLike& q, const std::string& orientation, const OutArray& out,
         const ThreadCount& threads) {
        const Orientation form = orientation_from_string(orientation);
        check_omni_base(c);
        return derivative(c, q, c.tool(), 6 + size_of(form), {out, threads},
                          [&](const Posture& posture, AnalyticJacobian& J) {
                            return task_jacobian(c, posture, form, J);
                          });
      },
      py::arg("q"), py::arg("orientation") = "quaternion", py::kw_only(),
      py::arg("out") = py::none(), py::arg("threads") = py::none(),
      R"(Derivative ds/dq of the task vector, [M17] (3.9) of (3.5).

Parameters
----------
q : (n,) or (N, n), rad and m
orientation : str
    'quaternion' or 'rpy', as for task_vector.
out : (10, n), (9, n) or batched float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(10, n) or (9, n), or a batch (N, 10, n) or (N, 9, n)

Raises
------
ValueError
    If the robot has no omnidirectional base; with 'rpy' at a pitch within 1e-9 rad of +-pi/2, as
    for analytic_jacobian.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> q = robot.random(rng=0)
>>> step = 1e-6 * np.eye(9)[3]
>>> central = (robot.task_vector(q + step) - robot.task_vector(q - step)) / 2e-6
>>> np.allclose(robot.task_jacobian(q)[:, 3], central, atol=1e-8)
True
)");
}

}  // namespace thing_kin::python
