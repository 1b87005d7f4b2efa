#include "thing_kin/kinematics/jacobian_dot.hpp"

#include "bindings.hpp"
#include "kinematics/motion.hpp"

namespace thing_kin::python {

void bind_jacobian_dot(ChainClass& chain) {
  chain.def(
      "jacobian_dot",
      [](const Chain& c, const ArrayLike& q, const ArrayLike& qd, const std::string& frame,
         const FrameLike& of, const PointLike& point, const OutArray& out,
         const ThreadCount& threads) {
        const ReferenceFrame reference = reference_frame_from_string(frame);
        const MovingPoint moving = read_point(c, of, point);
        auto batches = read_together<2>(c, {{{q, "q"}, {qd, "qd"}}});
        return map_together(batches, {6, c.dof()}, {out, threads}, [&](const auto& in, double* to) {
          Posture posture;
          Jacobian dJ;
          place_joints(c, in[0], posture);
          geometric_jacobian_dot(c, posture, moving, reference, in[1], dJ);
          write_matrix(dJ, to);
        });
      },
      py::arg("q"), py::arg("qd"), py::arg("frame") = "world_aligned", py::arg("of") = py::none(),
      py::arg("point") = py::none(), py::kw_only(), py::arg("out") = py::none(),
      py::arg("threads") = py::none(),
      R"(Time derivative of the Jacobian, dJ/dt = sum_k dJ/dq_k qd_k, without the Hessian.

It is the derivative of the numbers in `jacobian(q, frame, of, point)`. Not in the theses.

Parameters
----------
q : (n,) or (N, n), rad and m
qd : (n,) or (N, n), rad/s and m/s
    A single vector, here or in q, goes with every item of a batch.
frame, of, point
    As for jacobian.
out : (6, n) or (N, 6, n) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(6, n) or (N, 6, n)

Raises
------
ValueError
    If q, qd or point has a wrong shape, is not finite or beyond 1e50, or there is no such frame.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot, q, qd = tk.robots.ur5(), np.full(6, 0.3), np.linspace(-1.0, 1.0, 6)
>>> np.allclose(robot.jacobian_dot(q, qd), robot.hessian(q) @ qd)
True
)");
}

}  // namespace thing_kin::python
