#include "thing_kin/inverse/task_priority.hpp"

#include <vector>

#include <pybind11/stl.h>

#include "array.hpp"
#include "bindings.hpp"
#include "model/chain.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

/// What solve() returns.
class AnyStep : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(AnyStep, object, [](PyObject*) { return 1; })
};

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::AnyStep> {
  static constexpr auto name =
      const_name("thing_kin._core.TaskPriorityStep | thing_kin._core.LimitedStep");
};

}  // namespace pybind11::detail

namespace thing_kin::python {

namespace {

std::optional<JointVector> read_step_limit(const py::object& limit, int n) {
  if (limit.is_none()) {
    return std::nullopt;
  }
  return read_number_or_vector(limit, "step_limit", n, Finite::kNo);
}

// What is quick to read is read at once; the rest has the general way, which names what is wrong.
void read_vector(py::handle argument, const char* name, py::ssize_t n, JointVector& out) {
  out.resize(n);
  if (!read_plain(argument, {n}, out.data())) {
    out = vector_at(read(argument, name, {n}, false), 0);
  }
}

bool rigid(const double* rows, int n) {
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  for (int row = 0; row < n; ++row) {
    for (int col = 0; col < n; ++col) {
      T(row, col) = rows[n * row + col];
    }
  }
  return is_rigid(T);
}

void read_other_target(std::array<int, 2> shape, py::handle target, std::size_t i, double* out) {
  const auto [rows, cols] = shape;
  const std::string name = "targets[" + std::to_string(i) + "]";
  if (rows == 0) {
    throw InvalidArgument(name, py::str(py::type::of(target).attr("__name__")), "None");
  }
  Batch batch;
  if (cols == 0) {
    batch = read(target, name.c_str(), {rows}, false);
  } else {
    batch = read(target, name.c_str(), {rows, cols}, false);
    rows == 4 ? static_cast<void>(read_pose(batch.data, name.c_str()))
              : static_cast<void>(read_rotation(batch.data, name.c_str()));
  }
  std::copy_n(batch.data, batch.size, out);
}

void read_target(std::array<int, 2> shape, py::handle target, std::size_t i, double* out) {
  const auto [rows, cols] = shape;
  const bool done = rows == 0   ? target.is_none()
                    : cols == 0 ? read_plain(target, {rows}, out)
                                : read_plain(target, {rows, cols}, out) && rigid(out, rows);
  if (!done) {
    read_other_target(shape, target, i, out);
  }
}

// What one step needs, copied, so that another thread that writes the arrays can't disturb it.
struct Inputs {
  Inputs(const TaskPriority& solver, const ArrayLike& q_argument, const py::sequence& targets,
         const py::object& null_motion, const py::object& previous_step)
      : count(solver.tasks().size()) {
    const int n = solver.chain().dof();
    read_vector(q_argument, "q", n, q);
    const std::size_t given = targets.size();
    if (given != count) {
      throw InvalidArgument("targets", std::to_string(given),
                            std::to_string(count) + ", one a task");
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto target = py::reinterpret_steal<py::object>(
          PySequence_GetItem(targets.ptr(), static_cast<py::ssize_t>(i)));
      if (!target) {
        throw py::error_already_set();
      }
      read_target(solver.tasks()[i]->target_shape(solver.chain()), target, i, values[i].data());
      pointers[i] = values[i].data();
    }
    if (!null_motion.is_none()) {
      read_vector(null_motion, "null_motion", n, z);
    }
    if (!previous_step.is_none()) {
      if (!solver.options().limits) {
        throw InvalidArgument("previous", "a step without limits", "None, or limits=True");
      }
      read_vector(previous_step, "previous", n, previous);
    }
  }

  std::span<const double* const> goals() const { return {pointers.data(), count}; }
  const double* free_motion() const { return z.size() > 0 ? z.data() : nullptr; }
  const double* step_before() const { return previous.size() > 0 ? previous.data() : nullptr; }

  std::size_t count;
  JointVector q;
  JointVector z;
  JointVector previous;
  std::array<std::array<double, kMaxDof>, kMaxTasks> values;
  std::array<const double*, kMaxTasks> pointers;
};

// A step with its diagnosis, as Python sees it.
struct ExplainedStep : TaskPriorityStep {
  std::array<SmallVector, kMaxTasks + 1> sigma;  // empty for the null-space motion
};

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

JointVector dq_of(const TaskPriority& solver, const Inputs& inputs) {
  const py::gil_scoped_release release;
  if (solver.options().limits) {
    JointVector dq;
    solver.step_limited(inputs.q.data(), inputs.goals(), inputs.free_motion(), inputs.step_before(),
                        dq);
    return dq;
  }
  TaskPriorityStep step;
  solver.solve(inputs.q.data(), inputs.goals(), inputs.free_motion(), step);
  return step.dq;
}

std::unique_ptr<ExplainedStep> step_of(const TaskPriority& solver, const Inputs& inputs) {
  auto step = std::make_unique<ExplainedStep>();
  const py::gil_scoped_release release;
  solver.solve(inputs.q.data(), inputs.goals(), inputs.free_motion(), *step);
  solver.singular_values(inputs.q.data(), inputs.goals(), step->sigma);
  return step;
}

std::unique_ptr<LimitedStep> limited_step_of(const TaskPriority& solver, const Inputs& inputs) {
  auto step = std::make_unique<LimitedStep>();
  const py::gil_scoped_release release;
  solver.solve_limited(inputs.q.data(), inputs.goals(), inputs.free_motion(), inputs.step_before(),
                       *step);
  return step;
}

std::optional<LimitOptions> read_limit_options(bool limits, const std::optional<double>& dt,
                                               const std::optional<WheelLimits>& wheels) {
  if (!limits) {
    if (dt) {
      throw InvalidArgument("dt", text(*dt).append(" without limits"), "limits=True, or None");
    }
    if (wheels) {
      throw InvalidArgument("wheel_limits", "WheelLimits without limits", "limits=True, or None");
    }
    return std::nullopt;
  }
  if (!dt) {
    throw InvalidArgument("dt", "None with limits", "the duration of a step, s");
  }
  return LimitOptions(*dt, wheels);
}

TaskPriorityOptions read_options(const std::optional<std::string>& scheme,
                                 const std::optional<DifferentialInverse>& inverse,
                                 const std::optional<LimitOptions>& limits) {
  TaskPriorityOptions options =
      limits ? TaskPriorityOptions::limited(*limits) : TaskPriorityOptions();
  if (scheme) {
    options.scheme = scheme_from_string(*scheme);
  }
  if (inverse) {
    options.inverse = *inverse;
  }
  return options;
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

With limits=True each step is a bounded least-squares problem in strict order: it keeps the robot's
position, velocity and acceleration limits, the wheels' speeds and the intervals of set-based tasks,
and each task is met as well as these and the tasks before it allow. Without, limits are not looked
at.

A solver is immutable: any number of threads may share it.

Parameters
----------
robot : Chain
tasks : sequence of Task
    Highest priority first, at most 16 (two for 'nakamura').
scheme : str
    'nakamura': (4.16). 'siciliano': the same recursion for any number of tasks; exact, but unbounded
    where a lower task conflicts with a higher one. 'chiaverini': (4.17); stays bounded there, and
    converges more slowly. Default 'chiaverini', with limits 'siciliano', which is least squares.
inverse : Exact, Damped or SelectivelyDamped
    Default SelectivelyDamped(pi/4), with limits Damped(1e-4); SelectivelyDamped is none for limits.
singular_value_filter : SingularValueFilter, optional
    Applied to each inverted matrix first.
step_limit : float or (n,), optional
    Largest |dq| of each joint, rad or m. Scales each task's contribution, lowest priority first, and
    never the sum: the direction in which a higher task moves does not change. With limits one more
    bound of the least squares, which may change that direction to come nearer.
limits : bool
    Default False.
dt : float, s
    Duration of a step, with limits: a joint moves by at most velocity limit * dt.
wheel_limits : WheelLimits, optional
    With limits, for a mecanum base.

Raises
------
ValueError
    If a task, frame, scheme or limit does not fit the robot, or an option the others.

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
                       const std::optional<std::string>& scheme,
                       const std::optional<DifferentialInverse>& inverse,
                       const std::optional<SingularValueFilter>& filter,
                       const py::object& step_limit, bool limits, const std::optional<double>& dt,
                       const std::optional<WheelLimits>& wheel_limits) {
             for (const auto& task : tasks) {
               if (task == nullptr) {
                 throw InvalidArgument("tasks", "None", "tasks");
               }
             }
             TaskPriorityOptions options =
                 read_options(scheme, inverse, read_limit_options(limits, dt, wheel_limits));
             options.filter = filter;
             options.step_limit = read_step_limit(step_limit, robot.dof());
             return TaskPriority(robot, {tasks.begin(), tasks.end()}, std::move(options));
           }),
           py::arg("robot"), py::arg("tasks"), py::kw_only(), py::arg("scheme") = py::none(),
           py::arg("inverse") = py::none(), py::arg("singular_value_filter") = py::none(),
           py::arg("step_limit") = py::none(), py::arg("limits") = false,
           py::arg("dt") = py::none(), py::arg("wheel_limits") = py::none())
      .def_property_readonly("robot", &TaskPriority::chain, "The chain.")
      .def_property_readonly(
          "scheme", [](const TaskPriority& s) { return to_string(s.options().scheme); },
          "'nakamura', 'siciliano' or 'chiaverini'.")
      .def_property_readonly(
          "limits", [](const TaskPriority& s) { return s.options().limits.has_value(); },
          "Whether steps are bounded.")
      .def(
          "step",
          [](const TaskPriority& solver, const ArrayLike& q, const py::sequence& targets,
             const py::object& null_motion, const py::object& previous) {
            const Inputs inputs(solver, q, targets, null_motion, previous);
            return to_array(dq_of(solver, inputs));
          },
          py::arg("q"), py::arg("targets"), py::arg("null_motion") = py::none(),
          py::arg("previous") = py::none(),
          R"(One step dq towards the targets; q + dq is the next configuration.

Allocates no memory in the core and releases the GIL.

Parameters
----------
q : (n,), rad and m
targets : sequence
    One a task: (4, 4) for a pose, (3, 3) for an orientation, (3,) for a position or a base pose,
    (n,) for a posture; None where a task has no target.
null_motion : (n,), optional
    The z of (4.16), (4.17): motion wanted where all tasks leave the robot free.
previous : (n,), optional
    With limits, the step before this one: the acceleration, (dq - previous)/dt^2, is limited too, and
    speeds to what can still be stopped before a position limit. Default: the acceleration is free.

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
             const py::object& null_motion, const py::object& previous) -> AnyStep {
            const Inputs inputs(solver, q, targets, null_motion, previous);
            py::object step = solver.options().limits ? py::cast(limited_step_of(solver, inputs))
                                                      : py::cast(step_of(solver, inputs));
            return py::reinterpret_steal<AnyStep>(step.release());
          },
          py::arg("q"), py::arg("targets"), py::arg("null_motion") = py::none(),
          py::arg("previous") = py::none(),
          R"(As step, with what each task contributed.

Parameters
----------
q, targets, null_motion, previous
    As for step.

Returns
-------
TaskPriorityStep
    With limits a LimitedStep.

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
