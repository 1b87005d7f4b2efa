#include "thing_kin/rmma/manipulator_arm.hpp"

#include <pybind11/stl.h>

#include "search_arguments.hpp"
#include "search_bindings.hpp"

namespace thing_kin::python {

void bind_manipulator_arm(py::module_& m) {
  py::class_<ManipulatorArm, std::shared_ptr<ManipulatorArm>>(
      m, "ManipulatorArm", R"(A real arm for the experiment, instead of the thesis's simplified one.

The tool points down at a fixed height; the arm's inverse kinematics, in closed form, decides where
it can be, and its joints' velocity and acceleration limits how long a motion takes. What a motion of
no length takes is the world's own overhead.

Parameters
----------
chain : Chain
    Six joints with a closed form, fixed or on an omnidirectional base: `robots.pioneer_lx_ur5()`.
height : float
    m of the tool, in the frame of the base.
turn : float
    rad of the tool about the vertical.

Raises
------
ValueError
    If the chain has no closed form, a joint no limits, or a number is not finite.

Examples
--------
>>> import thing_kin as tk
>>> from thing_kin import rmma
>>> arm = rmma.ManipulatorArm(tk.robots.pioneer_lx_ur5())
>>> arm.reaches((0.2, 0.6)), arm.reaches((0.2, 1.6))
(True, False)
)")
      .def(py::init([](const Chain& chain, double height, double turn) {
             return std::make_shared<ManipulatorArm>(std::make_shared<const Chain>(chain), height,
                                                     turn);
           }),
           py::arg("chain"), py::arg("height") = 0.7, py::arg("turn") = 0.0)
      .def(
          "reaches",
          [](const ManipulatorArm& arm, const ArrayLike& displacement) {
            JointVector q = JointVector::Zero(arm.chain().dof());
            return arm.solve(read_point(displacement, "displacement"), q);
          },
          py::arg("displacement"),
          R"(Whether the tool can be at `displacement`, (2,) m from the base.

Examples
--------
>>> import thing_kin as tk
>>> from thing_kin import rmma
>>> arm = rmma.ManipulatorArm(tk.robots.pioneer_lx_ur5())
>>> arm.reaches((0.2, 0.6))
True
)")
      .def(
          "motion_time",
          [](const ManipulatorArm& arm, const ArrayLike& from, const ArrayLike& to) {
            JointVector q = JointVector::Zero(arm.chain().dof());
            if (!arm.solve(read_point(from, "a"), q)) {
              throw py::value_error("a: out of the arm's reach");
            }
            JointVector end = q;
            if (!arm.solve(read_point(to, "b"), end)) {
              throw py::value_error("b: out of the arm's reach");
            }
            return arm.motion_time(q, end);
          },
          py::arg("a"), py::arg("b"),
          R"(s from displacement `a`, (2,) m, to `b`, from rest to rest, without overhead.

Raises
------
ValueError
    If one of them is out of reach.

Examples
--------
>>> import thing_kin as tk
>>> from thing_kin import rmma
>>> arm = rmma.ManipulatorArm(tk.robots.pioneer_lx_ur5())
>>> 0.0 < arm.motion_time((0.2, 0.6), (0.2, 0.605)) < arm.motion_time((0.2, 0.6), (-0.2, 0.6)) < 1.0
True
)")
      .def_property_readonly("chain", &ManipulatorArm::chain,
                             py::return_value_policy::reference_internal, "The arm's chain.")
      .def(py::pickle(
          [](const ManipulatorArm& arm) {
            return py::make_tuple(arm.chain(), arm.height(), arm.turn());
          },
          [](const py::tuple& state) {
            return std::make_shared<ManipulatorArm>(
                std::make_shared<const Chain>(state[0].cast<const Chain&>()),
                state[1].cast<double>(), state[2].cast<double>());
          }));
}

}  // namespace thing_kin::python
