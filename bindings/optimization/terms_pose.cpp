#include "thing_kin/optimization/terms_pose.hpp"

#include "bindings.hpp"
#include "optimization/term_recipe.hpp"

namespace thing_kin::python {

namespace {

Array frozen_matrix(const Eigen::MatrixXd& matrix) {
  const py::ssize_t shape[] = {matrix.rows(), matrix.cols()};
  Array array = make_array(shape, 2);
  write_matrix(matrix, array.mutable_data());
  array.attr("flags").attr("writeable") = false;
  return array;
}

}  // namespace

void bind_terms_pose(py::module_& m) {
  TermClass<terms::Pose>(m, "Pose", R"(Where a frame should be: six numbers, zero there.

[p_goal - p; log(R_goal R^T)], axes of the world, as tk.pose_error: [M17] (4.26)-(4.28) with the
signs put right. At half a turn the logarithm jumps to the opposite axis.

Parameters
----------
target : (4, 4)
frame : str, optional
    Default: the tool.

Raises
------
ValueError
    If the target is no rigid transform.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.ur5()
>>> term = tk.terms.Pose(robot.fk(np.ones(6)))
>>> value, J = term.evaluate(robot, np.ones(6))
>>> np.allclose(value, 0.0), np.allclose(J, -robot.jacobian(np.ones(6)))
(True, True)
)")
      .def(py::init([](const ArrayLike& target, const FrameName& frame) {
             const Batch batch = read(target, "target", {4, 4}, false);
             return terms::Pose(read_pose(batch.data, "target"), frame.value_or(""));
           }),
           py::arg("target"), py::kw_only(), py::arg("frame") = py::none())
      .def_property_readonly(
          "target", [](const terms::Pose& term) { return frozen_matrix(term.target().matrix()); },
          "The pose, (4, 4).")
      .def_property_readonly(
          "frame", [](const terms::Pose& term) { return frame_or_none(term.frame()); },
          "None: the tool.")
      .def("__repr__", [](const terms::Pose& term) {
        return py::str("Pose(position={}, frame={!r})")
            .format(numbers_of(term.target().translation), frame_or_none(term.frame()));
      });
  TermClass<terms::Position>(m, "Position", R"(Where a point of a frame should be: p_goal - p, m.

Parameters
----------
target : (3,), m
    In the world.
frame : str, optional
    Default: the tool.
point : (3,), m, optional
    Coordinates in the frame; default: its origin.

Raises
------
ValueError
    If a shape is wrong or a number not finite.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.ur5()
>>> value, _ = tk.terms.Position((0, 0, 1), frame="shoulder").evaluate(robot, np.zeros(6))
>>> value
array([0.      , 0.      , 0.910841])
)")
      .def(
          py::init([](const ArrayLike& target, const FrameName& frame, const OptionalArray& point) {
            const Eigen::Vector3d at =
                point.is_none() ? Eigen::Vector3d::Zero().eval() : read_vector<3>(point, "point");
            return terms::Position(read_vector<3>(target, "target"), frame.value_or(""), at);
          }),
          py::arg("target"), py::kw_only(), py::arg("frame") = py::none(),
          py::arg("point") = py::none())
      .def_property_readonly(
          "target", [](const terms::Position& term) { return frozen(term.target()); },
          "In the world, (3,), m.")
      .def_property_readonly(
          "point", [](const terms::Position& term) { return frozen(term.point()); },
          "In the frame, (3,), m.")
      .def_property_readonly(
          "frame", [](const terms::Position& term) { return frame_or_none(term.frame()); },
          "None: the tool.")
      .def("__repr__", [](const terms::Position& term) {
        return py::str("Position({}, frame={!r}, point={})")
            .format(numbers_of(term.target()), frame_or_none(term.frame()),
                    numbers_of(term.point()));
      });
  TermClass<terms::Orientation>(m, "Orientation",
                                R"(How a frame should be turned: log(R_goal R^T), rad.

Parameters
----------
target : (3, 3)
frame : str, optional
    Default: the tool.

Raises
------
ValueError
    If the target is no rotation.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> value, _ = tk.terms.Orientation(np.eye(3)).evaluate(tk.robots.ur5(), np.zeros(6))
>>> value.round(6)
array([-1.570796,  0.      ,  0.      ])
)")
      .def(py::init([](const ArrayLike& target, const FrameName& frame) {
             const Batch batch = read(target, "target", {3, 3}, false);
             return terms::Orientation(read_rotation(batch.data, "target"), frame.value_or(""));
           }),
           py::arg("target"), py::kw_only(), py::arg("frame") = py::none())
      .def_property_readonly(
          "target", [](const terms::Orientation& term) { return frozen_matrix(term.target()); },
          "The rotation, (3, 3).")
      .def_property_readonly(
          "frame", [](const terms::Orientation& term) { return frame_or_none(term.frame()); },
          "None: the tool.")
      .def("__repr__", [](const terms::Orientation& term) {
        return py::str("Orientation(frame={!r})").format(frame_or_none(term.frame()));
      });
}

}  // namespace thing_kin::python
