#include "thing_kin/inverse/limited_step.hpp"

#include <utility>

#include "array.hpp"
#include "bindings.hpp"

namespace thing_kin::python {

namespace {

using Signs = py::array_t<std::int8_t>;

Array to_array(const JointVector& v) { return Array(v.size(), v.data()); }

Signs to_signs(const std::int8_t* signs, Eigen::Index count) { return Signs(count, signs); }

template <typename Get>
py::list for_each_level(const LimitedStep& step, Get get) {
  py::list list;
  for (int i = 0; i < step.count; ++i) {
    list.append(get(step.levels[static_cast<std::size_t>(i)]));
  }
  return list;
}

py::list kinds(const LimitedStep& step) {
  py::list list;
  for (std::size_t j = 0; std::cmp_less(j, step.dq.size()); ++j) {
    list.append(py::str(to_string(step.kinds[j])));
  }
  return list;
}

}  // namespace

void bind_limited_step(py::module_& m) {
  py::class_<LimitedStep>(m, "LimitedStep", R"(One step of TaskPriority with limits, explained.

A level is a task, highest priority first.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> solver = tk.TaskPriority(robot, [tk.BaseTask()], limits=True, dt=0.1, step_limit=0.05)
>>> step = solver.solve(np.zeros(9), [(0.1, 0.02, 0.0)])
>>> step.active_limits
array([0, 0, 0, 0, 0, 0, 1, 0, 0], dtype=int8)
>>> step.limit_kinds[6], step.residuals[0].round(3) + 0.0, step.status
('step', array([-0.05,  0.  ,  0.  ]), 'optimal')
)")
      .def_property_readonly(
          "dq", [](const LimitedStep& s) { return to_array(s.dq); }, "The step, (n,).")
      .def_property_readonly(
          "errors",
          [](const LimitedStep& s) {
            return for_each_level(s, [](const auto& level) { return to_array(level.error); });
          },
          "Error of each task before its gain; of a set-based task what leads back into its "
          "interval, zero inside.")
      .def_property_readonly(
          "residuals",
          [](const LimitedStep& s) {
            return for_each_level(s, [](const auto& level) { return to_array(level.residual); });
          },
          "What each level misses: J dq - gain * error; of a set-based task how far J dq is "
          "outside "
          "of what the interval allows, below negative.")
      .def_property_readonly(
          "active_limits",
          [](const LimitedStep& s) { return to_signs(s.active.data(), s.dq.size()); },
          "(n,), int8: 1 where dq is at its upper bound, -1 at its lower, 0 between.")
      .def_property_readonly("limit_kinds", &kinds,
                             "What each of these bounds comes from: 'position', 'velocity', "
                             "'acceleration', 'step', or '' between them.")
      .def_property_readonly(
          "active_intervals",
          [](const LimitedStep& s) {
            return for_each_level(s, [](const auto& level) {
              return to_signs(level.active.data(), level.interval ? level.error.size() : 0);
            });
          },
          "Of each set-based task's rows, int8: 1 where the step leads to the upper end or beyond, "
          "-1 the lower; empty for other tasks.")
      .def_property_readonly(
          "active_wheels", [](const LimitedStep& s) { return to_signs(s.wheels.data(), 4); },
          "(4,), int8: 1 or -1 where a wheel is at its limit; front left, rear left, rear right, "
          "front right.")
      .def_readonly("iterations", &LimitedStep::iterations,
                    "Of the active set, all levels together; 0 if nothing was in the way.")
      .def_property_readonly(
          "status", [](const LimitedStep& s) { return to_string(s.status); },
          "'optimal', or 'iteration_limit': limits and priorities hold, but a level may not be at "
          "its best.")
      .def("__repr__", [](const LimitedStep& s) {
        return py::str("LimitedStep(dq={}, active_limits={}, status={!r})")
            .format(to_array(s.dq), to_signs(s.active.data(), s.dq.size()), to_string(s.status));
      });
}

}  // namespace thing_kin::python
