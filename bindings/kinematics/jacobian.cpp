#include "thing_kin/kinematics/jacobian.hpp"

#include "bindings.hpp"
#include "kinematics/motion.hpp"
#include "thing_kin/kinematics/batch.hpp"

namespace thing_kin::python {

/// An argument `out` of two results: None or a pair of arrays.
class OutPair : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(OutPair, object, [](PyObject*) { return 1; })

  OutArray operator[](py::ssize_t i) const {
    if (is_none()) {
      return py::reinterpret_borrow<OutArray>(py::none());
    }
    if (PyTuple_Check(ptr()) == 0 || PyTuple_Size(ptr()) != 2) {
      throw InvalidArgument("out", py::str(py::type::of(*this).attr("__name__")),
                            "a tuple of two arrays");
    }
    return py::reinterpret_borrow<OutArray>(PyTuple_GetItem(ptr(), i));
  }
};

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::OutPair> {
  static constexpr auto name = const_name(
      "tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]] | None");
};

}  // namespace pybind11::detail

namespace thing_kin::python {

namespace {

Jacobian jacobian_at(const Chain& c, const double* q, const MovingPoint& of,
                     ReferenceFrame reference, Posture& posture) {
  Jacobian J;
  place_joints(c, q, posture);
  geometric_jacobian(c, posture, of, reference, J);
  return J;
}

JointBatch rows_of(const Batch& batch, int threads) {
  return {batch.data, static_cast<std::size_t>(batch.count), threads};
}

Array jacobian(const Chain& c, const ArrayLike& q, const std::string& frame, const FrameLike& of,
               const PointLike& point, const OutArray& out, const ThreadCount& threads) {
  const ReferenceFrame reference = reference_frame_from_string(frame);
  const MovingPoint moving = read_point(c, of, point);
  Batch batch = read_vectors(q, "q", c.dof());
  const int count = read_threads(threads);
  Array J = make_output(batch, {6, c.dof()}, out);
  double* to = J.mutable_data();
  if (batch.single) {
    Posture posture;
    write_matrix(jacobian_at(c, batch.data, moving, reference, posture), to);
    return J;
  }
  detach(batch, J);
  const py::gil_scoped_release release;
  geometric_jacobian(c, rows_of(batch, count), moving, reference, to);
  return J;
}

py::typing::Tuple<Array, Array> fk_and_jacobian(const Chain& c, const ArrayLike& q,
                                                const std::string& frame, const FrameLike& of,
                                                const OutPair& out, const ThreadCount& threads) {
  const ReferenceFrame reference = reference_frame_from_string(frame);
  const int index = read_frame(c, of, "of");
  Batch batch = read_vectors(q, "q", c.dof());
  const int count = read_threads(threads);
  Array T = make_output(batch, {4, 4}, out[0]);
  Array J = make_output(batch, {6, c.dof()}, out[1]);
  check_apart(T, J);
  detach(batch, T);
  detach(batch, J);
  double* const T_out = T.mutable_data();
  double* const J_out = J.mutable_data();
  if (batch.single) {
    Posture posture;
    write_matrix(jacobian_at(c, batch.data, index, reference, posture), J_out);
    write_pose(frame_pose(c, posture, index), T_out);
  } else {
    const py::gil_scoped_release release;
    forward_kinematics_and_jacobian(c, rows_of(batch, count), index, reference, T_out, J_out);
  }
  return py::make_tuple(T, J);
}

}  // namespace

void bind_jacobian(ChainClass& chain) {
  chain.def("jacobian", jacobian, py::arg("q"), py::arg("frame") = "world_aligned",
            py::arg("of") = py::none(), py::arg("point") = py::none(), py::kw_only(),
            py::arg("out") = py::none(), py::arg("threads") = py::none(),
            R"(Geometric Jacobian, [M17] (3.12)-(3.15): [linear; angular] velocity = J qd.

Parameters
----------
q : (n,) or (N, n), rad and m
frame : str
    'world_aligned': velocity of the point, axes of the world. 'body': the same, axes of the frame
    `of`. 'world': spatial twist, at the world's origin, whatever the point.
of : str or int, optional
    The frame that moves, from `frames`; default: the last, the tool.
point : (3,), m, optional
    A point fixed to that frame, by its coordinates in it; default: its origin.
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
    If q, point or out has a wrong shape, q or point is not finite, or there is no such frame.

Examples
--------
>>> import thing_kin as tk
>>> arm = tk.Chain.from_dh([tk.DH(a=2.0, joint="revolute")])
>>> arm.jacobian([0.0])[:, 0]
array([0., 2., 0., 0., 0., 1.])
)");
  chain.def("fk_and_jacobian", fk_and_jacobian, py::arg("q"), py::arg("frame") = "world_aligned",
            py::arg("of") = py::none(), py::kw_only(), py::arg("out") = py::none(),
            py::arg("threads") = py::none(),
            R"(Pose and Jacobian of a frame, for little more than the price of one.

Parameters
----------
q : (n,) or (N, n), rad and m
frame : str
    As in jacobian: 'world_aligned', 'body' or 'world'.
of : str or int, optional
    The frame, from `frames`; default: the last, the tool.
out : tuple of two float64 arrays in C order, shaped as T and J, optional
    Where the results go, and what is returned then; they share no memory.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
T : (4, 4) or (N, 4, 4)
J : (6, n) or (N, 6, n)

Raises
------
ValueError
    If q has a wrong shape or is not finite, there is no such frame, or `out` is no such tuple or
    its arrays share memory.

Examples
--------
>>> import thing_kin as tk
>>> T, J = tk.robots.ur5().fk_and_jacobian([0.0, -1.0, 1.0, 0.0, 1.0, 0.0])
>>> T.shape, J.shape
((4, 4), (6, 6))
)");
}

}  // namespace thing_kin::python
