#include "thing_kin/kinematics/jacobian.hpp"

#include "array.hpp"
#include "bindings.hpp"
#include "model/chain.hpp"

namespace thing_kin::python {

void bind_jacobian(ChainClass& chain) {
  chain.def(
      "jacobian",
      [](const Chain& c, const ArrayLike& q, const std::string& frame, const py::object& of) {
        const ReferenceFrame reference = reference_frame_from_string(frame);
        const int index = read_frame(c, of, "of");
        return map(read_vectors(q, "q", c.dof()), {6, c.dof()}, [&](const double* in, double* out) {
          Posture posture;
          Jacobian J;
          place_joints(c, in, posture);
          geometric_jacobian(c, posture, index, reference, J);
          write_matrix(J, out);
        });
      },
      py::arg("q"), py::arg("frame") = "world_aligned", py::arg("of") = py::none(),
      R"(Geometric Jacobian, [M17] (3.12)-(3.15): [linear; angular] velocity = J qd.

Parameters
----------
q : (n,) or (N, n), rad and m
frame : str
    'world_aligned': velocity of the frame's origin, axes of the world. 'body': the same, axes of
    the frame. 'world': spatial twist, at the world's origin.
of : str or int, optional
    The frame that moves, from `frames`; default: the last, the tool.

Returns
-------
(6, n) or (N, 6, n)

Raises
------
ValueError
    If q has a wrong shape or is not finite, or there is no such frame.

Examples
--------
>>> import thing_kin as tk
>>> arm = tk.Chain.from_dh([tk.DH(a=2.0, joint="revolute")])
>>> arm.jacobian([0.0])[:, 0]
array([0., 2., 0., 0., 0., 1.])
)");
}

}  // namespace thing_kin::python
