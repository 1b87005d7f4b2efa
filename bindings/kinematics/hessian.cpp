#include "thing_kin/kinematics/hessian.hpp"

#include "bindings.hpp"
#include "kinematics/motion.hpp"

namespace thing_kin::python {

void bind_hessian(ChainClass& chain) {
  chain.def(
      "hessian",
      [](const Chain& c, const ArrayLike& q, const std::string& frame, const FrameLike& of,
         const PointLike& point, const OutArray& out, const ThreadCount& threads) {
        const ReferenceFrame reference = reference_frame_from_string(frame);
        const MovingPoint moving = read_point(c, of, point);
        const int n = c.dof();
        return map(read_vectors(q, "q", n), {6, n, n}, {out, threads},
                   [&](const double* in, double* to) {
                     Posture posture;
                     Hessian H;
                     place_joints(c, in, posture);
                     geometric_hessian(c, posture, moving, reference, H);
                     for (int row = 0; row < 6; ++row) {
                       for (int i = 0; i < n; ++i) {
                         for (int k = 0; k < n; ++k) {
                           to[(row * n + i) * n + k] = H[static_cast<std::size_t>(k)](row, i);
                         }
                       }
                     }
                   });
      },
      py::arg("q"), py::arg("frame") = "world_aligned", py::arg("of") = py::none(),
      py::arg("point") = py::none(), py::kw_only(), py::arg("out") = py::none(),
      py::arg("threads") = py::none(),
      R"(Exact derivative of the Jacobian: H[:, :, k] = dJ/dq_k.

Parameters
----------
q : (n,) or (N, n), rad and m
frame, of, point
    As for jacobian.
out : (6, n, n) or (N, 6, n, n) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(6, n, n) or (N, 6, n, n)

Raises
------
ValueError
    If q or point has a wrong shape or is not finite, or there is no such frame.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot, q = tk.robots.ur5(), np.full(6, 0.3)
>>> step = 1e-6 * np.eye(6)[2]
>>> central = (robot.jacobian(q + step) - robot.jacobian(q - step)) / 2e-6
>>> np.allclose(robot.hessian(q)[:, :, 2], central, atol=1e-8)
True
)");
}

}  // namespace thing_kin::python
