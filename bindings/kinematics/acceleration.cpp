#include "thing_kin/kinematics/acceleration.hpp"

#include "bindings.hpp"
#include "kinematics/motion.hpp"

namespace thing_kin::python {

namespace {

using FirstOrder = Vector6 (*)(const Chain&, const Posture&, const MovingPoint&, ReferenceFrame,
                               const double*) noexcept;

Array of_velocities(const Chain& c, const ArrayLike& q, const ArrayLike& qd,
                    const std::string& frame, const FrameLike& of, const PointLike& point,
                    const Run& run, FirstOrder function) {
  const ReferenceFrame reference = reference_frame_from_string(frame);
  const MovingPoint moving = read_point(c, of, point);
  auto batches = read_together<2>(c, {{{q, "q"}, {qd, "qd"}}});
  return map_together(batches, {6}, run, [&](const auto& in, double* to) {
    Posture posture;
    place_joints(c, in[0], posture);
    Eigen::Map<Vector6>{to} = function(c, posture, moving, reference, in[1]);
  });
}

void bind_velocity(ChainClass& chain) {
  chain.def(
      "velocity",
      [](const Chain& c, const ArrayLike& q, const ArrayLike& qd, const std::string& frame,
         const FrameLike& of, const PointLike& point, const OutArray& out,
         const ThreadCount& threads) {
        return of_velocities(c, q, qd, frame, of, point, {out, threads}, frame_velocity);
      },
      py::arg("q"), py::arg("qd"), py::arg("frame") = "world_aligned", py::arg("of") = py::none(),
      py::arg("point") = py::none(), py::kw_only(), py::arg("out") = py::none(),
      py::arg("threads") = py::none(),
      R"(Velocity of a frame, or of a point fixed to it: J qd, [linear, angular].

Parameters
----------
q : (n,) or (N, n), rad and m
qd : (n,) or (N, n), rad/s and m/s
    A single vector, here or in q, goes with every item of a batch.
frame, of, point
    As for jacobian.
out : (6,) or (N, 6) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(6,) or (N, 6), m/s and rad/s

Raises
------
ValueError
    If q, qd or point has a wrong shape, is not finite or beyond 1e50, or there is no such frame.

Examples
--------
>>> import thing_kin as tk
>>> arm = tk.Chain.from_dh([tk.DH(a=2.0, joint="revolute")])
>>> arm.velocity([0.0], [3.0])
array([0., 6., 0., 0., 0., 3.])
)");
}

void bind_drift(ChainClass& chain) {
  chain.def(
      "drift",
      [](const Chain& c, const ArrayLike& q, const ArrayLike& qd, const std::string& frame,
         const FrameLike& of, const PointLike& point, const OutArray& out,
         const ThreadCount& threads) {
        return of_velocities(c, q, qd, frame, of, point, {out, threads}, frame_drift);
      },
      py::arg("q"), py::arg("qd"), py::arg("frame") = "world_aligned", py::arg("of") = py::none(),
      py::arg("point") = py::none(), py::kw_only(), py::arg("out") = py::none(),
      py::arg("threads") = py::none(),
      R"(The drift dJ/dt qd: the acceleration that is there without any qdd.

J qdd + drift is the derivative of J qd, so that qdd = J^+ (a - drift) is what an acceleration a
asks of the joints. It is jacobian_dot(q, qd) @ qd, without that matrix.

Parameters
----------
q : (n,) or (N, n), rad and m
qd : (n,) or (N, n), rad/s and m/s
    A single vector, here or in q, goes with every item of a batch.
frame, of, point
    As for jacobian.
out : (6,) or (N, 6) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(6,) or (N, 6), m/s^2 and rad/s^2
    [linear, angular]. With 'world_aligned' its linear part is a classical acceleration, else a
    spatial one (see acceleration).

Raises
------
ValueError
    If q, qd or point has a wrong shape, is not finite or beyond 1e50, or there is no such frame.

Examples
--------
>>> import thing_kin as tk
>>> arm = tk.Chain.from_dh([tk.DH(a=2.0, joint="revolute")])
>>> arm.drift([0.0], [3.0])  # centripetal
array([-18.,   0.,   0.,   0.,   0.,   0.])
)");
}

}  // namespace

void bind_acceleration(ChainClass& chain) {
  bind_velocity(chain);
  bind_drift(chain);
  chain.def(
      "acceleration",
      [](const Chain& c, const ArrayLike& q, const ArrayLike& qd, const ArrayLike& qdd,
         const std::string& frame, const FrameLike& of, const std::string& kind,
         const PointLike& point, const OutArray& out, const ThreadCount& threads) {
        const ReferenceFrame reference = reference_frame_from_string(frame);
        const AccelerationKind of_kind = acceleration_kind_from_string(kind);
        const MovingPoint moving = read_point(c, of, point);
        auto batches = read_together<3>(c, {{{q, "q"}, {qd, "qd"}, {qdd, "qdd"}}});
        return map_together(batches, {6}, {out, threads}, [&](const auto& in, double* to) {
          Posture posture;
          place_joints(c, in[0], posture);
          Eigen::Map<Vector6>{to} =
              frame_acceleration(c, posture, moving, reference, of_kind, in[1], in[2]);
        });
      },
      py::arg("q"), py::arg("qd"), py::arg("qdd"), py::arg("frame") = "world_aligned",
      py::arg("of") = py::none(), py::arg("kind") = "classical", py::arg("point") = py::none(),
      py::kw_only(), py::arg("out") = py::none(), py::arg("threads") = py::none(),
      R"(Acceleration of a frame, or of a point fixed to it, [linear, angular].

'classical', the default, is what an accelerometer at the point feels besides gravity: the second
derivative of its position. 'spatial' is the derivative of the twist, which rigid-body dynamics
transforms like a twist. Their angular parts are equal, and with the velocity [v, w] in the same
frame the linear parts are: classical = spatial + w x v.

The derivative of J qd, jacobian(q) @ qdd + drift(q, qd), is the classical one in 'world_aligned'
and the spatial one in 'body' and 'world'.

Parameters
----------
q : (n,) or (N, n), rad and m
qd : (n,) or (N, n), rad/s and m/s
qdd : (n,) or (N, n), rad/s^2 and m/s^2
    A single vector, here, in q or in qd, goes with every item of a batch.
frame : str
    'world_aligned': of the point, axes of the world. 'body': the same, axes of the frame. 'world':
    of the point of the moving body that is now at the world's origin.
of, point
    As for jacobian.
kind : str
    'classical' or 'spatial'.
out : (6,) or (N, 6) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(6,) or (N, 6), m/s^2 and rad/s^2

Raises
------
ValueError
    If q, qd, qdd or point has a wrong shape, is not finite or beyond 1e50, or there is no such
    frame or kind.

Examples
--------
>>> import thing_kin as tk
>>> arm = tk.Chain.from_dh([tk.DH(a=2.0, joint="revolute")])
>>> arm.acceleration([0.0], [3.0], [0.5])
array([-18. ,   1. ,   0. ,   0. ,   0. ,   0.5])
>>> arm.acceleration([0.0], [3.0], [0.5], kind="spatial")
array([0. , 1. , 0. , 0. , 0. , 0.5])
)");
}

}  // namespace thing_kin::python
