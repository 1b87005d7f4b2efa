#include "thing_kin/inverse/task_priority.hpp"

#include <vector>

#include <pybind11/stl.h>

#include "array.hpp"
#include "bindings.hpp"
#include "model/chain.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

std::optional<JointVector> read_step_limit(const py::object& limit, int n) {
  if (limit.is_none()) {
    return std::nullopt;
  }
  return read_number_or_vector(limit, "step_limit", n, Finite::kNo);
}

// One target, checked, and kept alive by its Batch.
Batch read_target(const Task& task, const Chain& chain, py::handle target, std::size_t i) {
  const auto [rows, cols] = task.target_shape(chain);
  const std::string name = "targets[" + std::to_string(i) + "]";
  if (cols == 0) {
    return read(target, name.c_str(), {rows}, false);
  }
  Batch batch = read(target, name.c_str(), {rows, cols}, false);
  if (rows == 4) {
    read_pose(batch.data, name.c_str());
  } else {
    read_rotation(batch.data, name.c_str());
  }
  return batch;
}

// What one step needs, copied, so that another thread that writes the arrays can't disturb it.
struct Inputs {
  Inputs(const TaskPriority& solver, const ArrayLike& q_argument, const py::sequence& targets,
         const py::object& null_motion)
      : count(solver.tasks().size()) {
    const int n = solver.chain().dof();
    q = vector_at(read(q_argument, "q", {n}, false), 0);
    if (targets.size() != count) {
      throw InvalidArgument("targets", std::to_string(targets.size()),
                            std::to_string(count) + ", one a task");
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Batch target =
          read_target(*solver.tasks()[i], solver.chain(), py::object(targets[i]), i);
      std::copy_n(target.data, target.size, values[i].begin());
      pointers[i] = values[i].data();
    }
    if (!null_motion.is_none()) {
      z = vector_at(read(null_motion, "null_motion", {n}, false), 0);
    }
  }

  std::span<const double* const> goals() const { return {pointers.data(), count}; }
  const double* free_motion() const { return z.size() > 0 ? z.data() : nullptr; }

  std::size_t count;
  JointVector q;
  JointVector z;
  std::array<std::array<double, kMaxDof>, kMaxTasks> values;
  std::array<const double*, kMaxTasks> pointers{};
};

// A step with its diagnosis, as Python sees it.
struct ExplainedStep : TaskPriorityStep {
  std::array<SmallVector, kMaxTasks + 1> sigma;  // empty for the null-space motion
};

Array to_array(const JointVector& v) { return Array(v.size(), v.data()); }

Array contributions(const ExplainedStep& step) {
  const py::ssize_t n = step.dq.size();
  const py::ssize_t shape[] = {step.count, n};
  Array out = make_array(shape, 2);
  for (int i = 0; i < step.count; ++i) {
    const JointVector& c = step.levels[static_cast<std::size_t>(i)].contribution;
    std::copy_n(c.data(), n, out.mutable_data() + i * n);
  }
  return out;
}

Array scales(const ExplainedStep& step) {
  const py::ssize_t shape[] = {step.count};
  Array out = make_array(shape, 1);
  for (int i = 0; i < step.count; ++i) {
    out.mutable_data()[i] = step.levels[static_cast<std::size_t>(i)].scale;
  }
  return out;
}

void bind_step(py::module_& m) {
  py::class_<ExplainedStep>(m, "TaskPriorityStep", R"(One step of TaskPriority, explained.

A level is a task, highest priority first; the free null-space motion, if any, comes last.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> solver = tk.TaskPriority(robot, [tk.BaseTask()])
>>> step = solver.solve(np.zeros(9), [(0.1, 0.2, 0.3)])
>>> step.errors[0]
array([0.1, 0.2, 0.3])
)")
      .def_property_readonly(
          "dq", [](const ExplainedStep& s) { return to_array(s.dq); },
          "The step, (n,): the sum of scale * contribution.")
      .def_property_readonly("contributions", &contributions,
                             "(levels, n), each in the null space of the levels above it, before "
                             "the step limit.")
      .def_property_readonly("scales", &scales,
                             "(levels,): what the step limit left of each, 0 to 1.")
      .def_property_readonly(
          "limited",
          [](const ExplainedStep& s) {
            return std::any_of(s.levels.begin(), s.levels.begin() + s.count,
                               [](const auto& level) { return level.scale < 1.0; });
          },
          "Whether the step limit took anything away.")
      .def_property_readonly(
          "errors",
          [](const ExplainedStep& s) {
            py::list list;
            for (int i = 0; i < s.count; ++i) {
              list.append(to_array(s.levels[static_cast<std::size_t>(i)].error));
            }
            return list;
          },
          "Error of each task before its gain; empty for the null-space motion.")
      .def_property_readonly(
          "singular_values",
          [](const ExplainedStep& s) {
            py::list list;
            for (int i = 0; i < s.count; ++i) {
              list.append(to_array(s.sigma[static_cast<std::size_t>(i)]));
            }
            return list;
          },
          "Of the matrix that each level inverted, before any filter.")
      .def("__repr__", [](const ExplainedStep& s) {
        return py::str("TaskPriorityStep(dq={}, scales={})").format(to_array(s.dq), scales(s));
      });
}

}  // namespace

void bind_task_priority(py::module_& m) {
  bind_step(m);
  py::class_<TaskPriority>(m, "TaskPriority",
                           R"(Prioritized inverse differential kinematics, [M17] 4.3.

The first task is met as well as it can be; each further one moves only in what the tasks before it
leave free, so that it never disturbs them, also when the inverse is damped or filtered. With tasks
[PoseTask(), BaseTask()] and scheme 'chiaverini' this is the motion scheme (4.18).

A solver is immutable: any number of threads may share it. Joint limits are not enforced.

Parameters
----------
robot : Chain
tasks : sequence of Task
    Highest priority first, at most 16 (two for 'nakamura').
scheme : str
    'nakamura': (4.16). 'siciliano': the same recursion for any number of tasks; exact, but unbounded
    where a lower task conflicts with a higher one. 'chiaverini' (default): (4.17); stays bounded
    there, and converges more slowly.
inverse : Exact, Damped or SelectivelyDamped
    Default SelectivelyDamped(pi/4).
singular_value_filter : SingularValueFilter, optional
    Applied to each inverted matrix first.
step_limit : float or (n,), optional
    Largest |dq| of each joint, rad or m. Scales each task's contribution, lowest priority first, and
    never the sum: the direction in which a higher task moves does not change.

Raises
------
ValueError
    If a task, frame, scheme or limit does not fit the robot.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> q = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
>>> T_goal = robot.fk(q + 0.1)
>>> solver = tk.TaskPriority(robot, tasks=[tk.PoseTask(), tk.BaseTask(gain=0.5)])
>>> for _ in range(100):
...     q = q + solver.step(q, [T_goal, (0.2, 0.0, 0.1)])
>>> bool(np.linalg.norm(tk.pose_error(robot.fk(q), T_goal)) < 1e-6)
True
)")
      .def(py::init([](const Chain& robot, const std::vector<std::shared_ptr<Task>>& tasks,
                       const std::string& scheme, const DifferentialInverse& inverse,
                       const std::optional<SingularValueFilter>& filter,
                       const py::object& step_limit) {
             for (const auto& task : tasks) {
               if (task == nullptr) {
                 throw InvalidArgument("tasks", "None", "tasks");
               }
             }
             return TaskPriority(robot, {tasks.begin(), tasks.end()},
                                 {scheme_from_string(scheme), inverse, filter,
                                  read_step_limit(step_limit, robot.dof())});
           }),
           py::arg("robot"), py::arg("tasks"), py::kw_only(),
           py::arg("scheme") = to_string(TaskPriorityOptions().scheme),
           py::arg("inverse") = DifferentialInverse(SelectivelyDamped()),
           py::arg("singular_value_filter") = py::none(), py::arg("step_limit") = py::none())
      .def_property_readonly("robot", &TaskPriority::chain, "The chain.")
      .def_property_readonly(
          "scheme", [](const TaskPriority& s) { return to_string(s.options().scheme); },
          "'nakamura', 'siciliano' or 'chiaverini'.")
      .def(
          "step",
          [](const TaskPriority& solver, const ArrayLike& q, const py::sequence& targets,
             const py::object& null_motion) {
            const Inputs inputs(solver, q, targets, null_motion);
            TaskPriorityStep step;
            {
              const py::gil_scoped_release release;
              solver.solve(inputs.q.data(), inputs.goals(), inputs.free_motion(), step);
            }
            return to_array(step.dq);
          },
          py::arg("q"), py::arg("targets"), py::arg("null_motion") = py::none(),
          R"(One step dq towards the targets; q + dq is the next configuration.

Allocates no memory in the core and releases the GIL.

Parameters
----------
q : (n,), rad and m
targets : sequence
    One a task: (4, 4) for a pose, (3, 3) for an orientation, (3,) for a position or a base pose,
    (n,) for a posture.
null_motion : (n,), optional
    The z of (4.16), (4.17): motion wanted where all tasks leave the robot free.

Returns
-------
(n,)

Raises
------
ValueError
    If a shape does not fit, a number is not finite or a pose is not rigid.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> q = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
>>> solver = tk.TaskPriority(robot, [tk.PositionTask()])
>>> solver.step(q, [robot.fk(q)[:3, 3]]) + 0.0  # there already
array([0., 0., 0., 0., 0., 0., 0., 0., 0.])
)")
      .def(
          "solve",
          [](const TaskPriority& solver, const ArrayLike& q, const py::sequence& targets,
             const py::object& null_motion) {
            const Inputs inputs(solver, q, targets, null_motion);
            auto step = std::make_unique<ExplainedStep>();
            const py::gil_scoped_release release;
            solver.solve(inputs.q.data(), inputs.goals(), inputs.free_motion(), *step);
            solver.singular_values(inputs.q.data(), inputs.goals(), step->sigma);
            return step;
          },
          py::arg("q"), py::arg("targets"), py::arg("null_motion") = py::none(),
          R"(As step, with what each task contributed.

Parameters
----------
q, targets, null_motion
    As for step.

Returns
-------
TaskPriorityStep

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> q = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
>>> solver = tk.TaskPriority(robot, [tk.PoseTask(), tk.BaseTask()], step_limit=0.05)
>>> step = solver.solve(q, [robot.fk(q), (1.0, 0.0, 0.0)])
>>> step.limited, bool(abs(step.dq).max() <= 0.05)
(True, True)
)")
      .def("__repr__", [](const TaskPriority& s) {
        return py::str("TaskPriority({!r}, {} tasks, scheme={!r})")
            .format(s.chain().name(), s.tasks().size(), to_string(s.options().scheme));
      });
}

}  // namespace thing_kin::python
