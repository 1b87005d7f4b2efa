#include "thing_kin/inverse/set_task.hpp"

#include <limits>
#include <memory>
#include <optional>

#include <pybind11/stl.h>

#include "array.hpp"
#include "bindings.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

// A vector of joints, of any length that a chain may have.
JointVector read_joints(const py::object& values, const char* name) {
  const auto array = py::array::ensure(values);
  if (!array) {
    throw InvalidArgument(name, py::str(py::type::of(values).attr("__name__")),
                          "an array of real numbers");
  }
  if (array.ndim() != 1 || array.shape(0) < 1 || array.shape(0) > kMaxDof) {
    throw InvalidArgument(name, "shape " + std::string(py::str(array.attr("shape"))),
                          "a number for each joint");
  }
  return vector_at(read(values, name, {array.shape(0)}, false, Finite::kNo), 0);
}

void bind_distance(py::module_& m) {
  py::class_<DistanceTask, SetTask, std::shared_ptr<DistanceTask>>(
      m, "DistanceTask", R"(Keep a frame's origin at a distance from a point; target (3,), m.

Parameters
----------
lower, upper : float, m
    The interval of the distance; upper may be inf (the default), lower 0.
gain : float in (0, 1]
    The share of an excess that one step takes away.
of : str, optional
    The frame; default: the tool.

Raises
------
ValueError
    If not 0 <= lower <= upper, or the gain is out of range.

Examples
--------
>>> import thing_kin as tk
>>> tk.DistanceTask(lower=0.3, of="forearm")
DistanceTask(lower=0.3, upper=inf, gain=1.0, of='forearm')
)")
      .def(py::init(
               [](double lower, double upper, double gain, const std::optional<std::string>& of) {
                 return std::make_shared<DistanceTask>(lower, upper, gain, of.value_or(""));
               }),
           py::arg("lower") = 0.0, py::arg("upper") = std::numeric_limits<double>::infinity(),
           py::arg("gain") = 1.0, py::kw_only(), py::arg("of") = py::none())
      .def_property_readonly("lower", &DistanceTask::lower, "The least distance, m.")
      .def_property_readonly("upper", &DistanceTask::upper, "The largest distance, m.")
      .def("__repr__", [](const py::object& self) {
        return py::str("DistanceTask(lower={}, upper={}, gain={}, of={!r})")
            .format(self.attr("lower"), self.attr("upper"), self.attr("gain"), self.attr("of"));
      });
}

void bind_base_obstacle(py::module_& m) {
  py::class_<BaseObstacleTask, SetTask, std::shared_ptr<BaseObstacleTask>>(
      m, "BaseObstacleTask", R"(Keep the base away from an obstacle; target: its center (x, y), m.

||p_base - p_obstacle|| >= R, [M17] (4.29) with its sign put right. The distance is a convex function
of q, so that no step crosses the circle.

Parameters
----------
radius : float, m
    The least distance of the base's origin from the center.
gain : float in (0, 1]
    The share of an excess that one step takes away.

Raises
------
ValueError
    If the radius is not positive, or the gain is out of range.

Examples
--------
>>> import thing_kin as tk
>>> tk.BaseObstacleTask(radius=0.8)
BaseObstacleTask(radius=0.8, gain=1.0)
)")
      .def(py::init<double, double>(), py::arg("radius"), py::arg("gain") = 1.0)
      .def_property_readonly("radius", &BaseObstacleTask::radius, "The least distance, m.")
      .def("__repr__", [](const BaseObstacleTask& task) {
        return py::str("BaseObstacleTask(radius={}, gain={})").format(task.radius(), task.gain());
      });
}

void bind_field_of_view(py::module_& m) {
  py::class_<FieldOfViewTask, SetTask, std::shared_ptr<FieldOfViewTask>>(
      m, "FieldOfViewTask", R"(Keep a point in a camera's view; target: the point (3,), m.

The angle between an axis of a frame and the direction from its origin to the point stays within a
limit.

Parameters
----------
limit : float in (0, pi), rad
    Half the cone's opening.
axis : (3,), optional
    Where the camera looks, in the frame; default: z.
gain : float in (0, 1]
    The share of an excess that one step takes away.
of : str, optional
    The frame; default: the tool.

Raises
------
ValueError
    If the limit, the axis or the gain is out of range.

Examples
--------
>>> import thing_kin as tk
>>> tk.FieldOfViewTask(0.5).axis
array([0., 0., 1.])
)")
      .def(py::init([](double limit, const py::object& axis, double gain,
                       const std::optional<std::string>& of) {
             Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
             if (!axis.is_none()) {
               direction = vector_at(read(axis, "axis", {3}, false), 0);
             }
             return std::make_shared<FieldOfViewTask>(limit, direction, gain, of.value_or(""));
           }),
           py::arg("limit"), py::arg("axis") = py::none(), py::arg("gain") = 1.0, py::kw_only(),
           py::arg("of") = py::none())
      .def_property_readonly("limit", &FieldOfViewTask::limit, "The largest angle, rad.")
      .def_property_readonly(
          "axis", [](const FieldOfViewTask& task) { return frozen(task.axis()); },
          "In the frame, of unit length.")
      .def("__repr__", [](const py::object& self) {
        return py::str("FieldOfViewTask(limit={}, axis={}, gain={}, of={!r})")
            .format(self.attr("limit"), self.attr("axis"), self.attr("gain"), self.attr("of"));
      });
}

void bind_joint_range(py::module_& m) {
  py::class_<JointRangeTask, SetTask, std::shared_ptr<JointRangeTask>>(
      m, "JointRangeTask", R"(Keep joints in ranges narrower than their limits; target: None.

Unlike the limits, which always hold, it has the priority of its place among the tasks.

Parameters
----------
lower, upper : (n,), rad and m
    -inf and inf for joints that are free.
gain : float in (0, 1]
    The share of an excess that one step takes away.

Raises
------
ValueError
    If lower exceeds upper, or the gain is out of range.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> task = tk.JointRangeTask(np.full(9, -1.0), np.full(9, 1.0))
>>> task.upper[0]
np.float64(1.0)
)")
      .def(py::init([](const ArrayLike& lower, const ArrayLike& upper, double gain) {
             JointVector low = read_joints(lower, "lower");
             return std::make_shared<JointRangeTask>(std::move(low), read_joints(upper, "upper"),
                                                     gain);
           }),
           py::arg("lower"), py::arg("upper"), py::arg("gain") = 1.0)
      .def_property_readonly(
          "lower", [](const JointRangeTask& task) { return frozen(task.lower()); },
          "The ranges' lower ends, rad and m.")
      .def_property_readonly(
          "upper", [](const JointRangeTask& task) { return frozen(task.upper()); },
          "The ranges' upper ends, rad and m.")
      .def("__repr__", [](const JointRangeTask& task) {
        return py::str("JointRangeTask({} joints, gain={})").format(task.joints(), task.gain());
      });
}

}  // namespace

void bind_set_task(py::module_& m) {
  const py::class_<SetTask, Task, std::shared_ptr<SetTask>> base(
      m, "SetTask",
      R"(What TaskPriority with limits can be asked to keep in an interval: the base of those tasks.

After Moe, Antonelli, Teel, Pettersen and Schrimpf (2016). Inside its interval it asks for nothing;
a step may go to its end, and no further. Outside, the step takes away `gain` of the excess. An
interval is kept to first order: one with a curved bound may be missed by the square of a step, and
the next step takes that back.

Examples
--------
>>> import thing_kin as tk
>>> isinstance(tk.BaseObstacleTask(0.5), tk.SetTask)
True
)");
  bind_distance(m);
  bind_base_obstacle(m);
  bind_field_of_view(m);
  bind_joint_range(m);
}

}  // namespace thing_kin::python
