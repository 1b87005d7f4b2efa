#include "thing_kin/inverse/task.hpp"

#include <memory>
#include <optional>

#include <pybind11/stl.h>

#include "bindings.hpp"

namespace thing_kin::python {

namespace {

// A task that is about a frame of the robot.
template <typename T>
void bind_frame_task(py::module_& m, const char* name, const char* doc) {
  py::class_<T, Task, std::shared_ptr<T>>(m, name, doc)
      .def(py::init([](double gain, const std::optional<std::string>& of) {
             return std::make_shared<T>(gain, of.value_or(""));
           }),
           py::arg("gain") = 1.0, py::kw_only(), py::arg("of") = py::none())
      .def("__repr__", [](const T& task) {
        return task.frame().empty()
                   ? py::str("{}(gain={})").format(task.kind(), task.gain())
                   : py::str("{}(gain={}, of={!r})").format(task.kind(), task.gain(), task.frame());
      });
}

template <typename T>
void bind_joint_task(py::module_& m, const char* name, const char* doc) {
  py::class_<T, Task, std::shared_ptr<T>>(m, name, doc)
      .def(py::init<double>(), py::arg("gain") = 1.0)
      .def("__repr__",
           [](const T& task) { return py::str("{}(gain={})").format(task.kind(), task.gain()); });
}

}  // namespace

void bind_task(py::module_& m) {
  py::class_<Task, std::shared_ptr<Task>>(
      m, "Task", R"(What TaskPriority can be asked to do: the base of all tasks.

Examples
--------
>>> import thing_kin as tk
>>> isinstance(tk.PoseTask(), tk.Task)
True
)")
      .def_property_readonly("gain", &Task::gain, "The step asks for gain * error, [M17] (4.3).")
      .def_property_readonly(
          "of",
          [](const Task& task) {
            return task.frame().empty() ? std::nullopt : std::optional<std::string>(task.frame());
          },
          "The frame it is about; None: the tool.");
  bind_frame_task<PoseTask>(m, "PoseTask", R"(Bring a frame to a pose; target (4, 4).

Parameters
----------
gain : float > 0
    1 asks for the whole error in one step.
of : str, optional
    The frame; default: the tool.

Examples
--------
>>> import thing_kin as tk
>>> tk.PoseTask(gain=0.5)
PoseTask(gain=0.5)
)");
  bind_frame_task<PositionTask>(m, "PositionTask",
                                R"(Bring a frame's origin to a point; target (3,), m.

Parameters
----------
gain : float > 0
of : str, optional
    The frame; default: the tool.

Examples
--------
>>> import thing_kin as tk
>>> tk.PositionTask(of="wrist_1")
PositionTask(gain=1.0, of='wrist_1')
)");
  bind_frame_task<OrientationTask>(m, "OrientationTask",
                                   R"(Turn a frame to an orientation; target (3, 3).

Parameters
----------
gain : float > 0
of : str, optional
    The frame; default: the tool.

Examples
--------
>>> import thing_kin as tk
>>> tk.OrientationTask()
OrientationTask(gain=1.0)
)");
  bind_joint_task<BaseTask>(m, "BaseTask", R"(Bring the base to a planar pose; target (x, y, theta).

The error of theta is wrapped to (-pi, pi].

Parameters
----------
gain : float > 0

Examples
--------
>>> import thing_kin as tk
>>> tk.BaseTask(gain=0.5)
BaseTask(gain=0.5)
)");
  bind_joint_task<PostureTask>(m, "PostureTask",
                               R"(Bring all joints to a configuration; target (n,).

The theta of a base and continuous joints go the short way round.

Parameters
----------
gain : float > 0

Examples
--------
>>> import thing_kin as tk
>>> tk.PostureTask(gain=0.1)
PostureTask(gain=0.1)
)");
}

}  // namespace thing_kin::python
