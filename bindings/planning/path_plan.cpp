#include "thing_kin/planning/path_plan.hpp"

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "map.hpp"
#include "planning/path_problem.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

/// A thing_kin.path_plan.PathPlan.
class PathPlanObject : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(PathPlanObject, object, [](PyObject*) { return 1; })
};

/// What to begin with: configurations, a plan that has them, or None.
class WarmStart : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(WarmStart, object, [](PyObject*) { return 1; })
};

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::PathPlanObject> {
  static constexpr auto name = const_name("thing_kin.path_plan.PathPlan");
};

template <>
struct handle_type_name<thing_kin::python::WarmStart> {
  static constexpr auto name =
      const_name("numpy.typing.ArrayLike | thing_kin.path_plan.PathPlan | None");
};

}  // namespace pybind11::detail

namespace thing_kin::python {

namespace {

std::vector<PathGoal> read_goals(const ArrayLike& poses) {
  Batch batch = read(poses, "poses", {4, 4});
  check_magnitude(batch, "poses");
  if (batch.count < 1) {
    throw InvalidArgument("poses", "none", "(N, 4, 4) with N > 0");
  }
  std::vector<PathGoal> goals(static_cast<std::size_t>(batch.count));
  for (std::size_t k = 0; k < goals.size(); ++k) {
    goals[k].pose = read_goal_pose(batch.item(static_cast<py::ssize_t>(k)), "poses");
  }
  return goals;
}

// Of a matrix; 0 for anything else, which read() has a message for.
py::ssize_t columns_of(const py::object& argument) {
  try {
    const py::object array = py::module_::import("numpy").attr("asarray")(argument);
    const auto shape = array.attr("shape").cast<py::tuple>();
    return shape.size() == 2 ? shape[1].cast<py::ssize_t>() : 0;
  } catch (const py::error_already_set&) {
    return 0;
  }
}

// x, y and, if there is a third column, theta: unwrapped, and by whole turns nearest to the seed's.
void read_base_path(const OptionalArray& argument, double theta, PathProblem& problem,
                    std::vector<PathGoal>& goals) {
  if (argument.is_none()) {
    if (problem.base_radius < kUnlimited) {
      throw InvalidArgument("base_radius", text(problem.base_radius), "None without a base_path");
    }
    return;
  }
  check_omni_base(problem.chain());
  const py::ssize_t columns = columns_of(argument) == 2 ? 2 : 3;
  const Batch path = read(argument, "base_path", {columns});
  check_magnitude(path, "base_path");
  if (path.single || !std::cmp_equal(path.count, goals.size())) {
    throw InvalidArgument("base_path", std::to_string(path.count).append(" rows"),
                          "one for each of the poses");
  }
  problem.has_base_path = true;
  problem.has_base_heading = columns == 3;
  for (std::size_t k = 0; k < goals.size(); ++k) {
    const double* row = path.item(static_cast<py::ssize_t>(k));
    theta = columns == 3 ? nearest_turn(row[2], theta) : theta;
    goals[k].base << row[0], row[1], theta;
  }
}

std::vector<JointVector> read_warm_start(const WarmStart& argument, const Chain& robot) {
  std::vector<JointVector> q;
  if (argument.is_none()) {
    return q;
  }
  py::object array = argument;
  if (py::hasattr(argument, "q")) {
    array = argument.attr("q");
  }
  const Batch batch = read(array, "warm_start", {robot.dof()});
  check_magnitude(batch, "warm_start");
  for (py::ssize_t k = 0; k < batch.count; ++k) {
    q.emplace_back(vector_at(batch, k));
  }
  return q;
}

Array to_array(const std::vector<double>& values) {
  return Array(static_cast<py::ssize_t>(values.size()), values.data());
}

PathPlanObject to_python(const py::object& robot, const PathPlan& plan) {
  const auto count = static_cast<py::ssize_t>(plan.q.size());
  const py::ssize_t shape[] = {count, plan.q.front().size()};
  Array q = make_array(shape, 2);
  for (py::ssize_t k = 0; k < count; ++k) {
    const JointVector& row = plan.q[static_cast<std::size_t>(k)];
    std::copy_n(row.data(), row.size(), q.mutable_data() + k * row.size());
  }
  const bool failed = plan.failed_waypoint >= 0;
  const py::object type = py::module_::import("thing_kin.path_plan").attr("PathPlan");
  return py::reinterpret_steal<PathPlanObject>(
      type(py::arg("robot") = robot, py::arg("q") = q,
           py::arg("position_error") = to_array(plan.position_error),
           py::arg("rotation_error") = to_array(plan.rotation_error),
           py::arg("success") = plan.success, py::arg("status") = to_string(plan.status),
           py::arg("message") = plan.message,
           py::arg("failed_waypoint") =
               failed ? py::object(py::int_(plan.failed_waypoint)) : py::object(py::none()),
           py::arg("failed_constraint") =
               failed ? py::object(py::str(plan.failed_constraint)) : py::object(py::none()),
           py::arg("objective") = plan.objective, py::arg("dexterity") = to_array(plan.dexterity),
           py::arg("constraint_violation") = plan.constraint_violation,
           py::arg("iterations") = plan.iterations, py::arg("time") = plan.time)
          .release());
}

}  // namespace

void bind_path_plan(py::module_& m) {
  const PathOptions defaults;
  const auto none = py::none();
  m.def(
      "plan_path",
      [](const Chain& robot, const ArrayLike& poses, const ArrayLike& seed, const FrameLike& frame,
         const OptionalArray& base_path, std::optional<double> base_radius,
         const OptionalArray& heading, const ObstacleList& obstacles, const SpheresLike& spheres,
         const std::string& method, const OptionalArray& max_joint_step,
         const OptionalArray& joint_weights, const JacobianColumns& jacobian,
         std::optional<double> dexterity_weight, const WarmStart& warm_start, int max_iterations,
         double position_tolerance, double rotation_tolerance, double constraint_tolerance) {
        PathOptions options;
        options.method = path_method_from_string(method);
        options.max_iterations = max_iterations;
        options.position_tolerance = position_tolerance;
        options.rotation_tolerance = rotation_tolerance;
        options.constraint_tolerance = constraint_tolerance;
        options.check();
        std::vector<PathGoal> goals = read_goals(poses);
        const Batch start = read(seed, "seed", {robot.dof()}, false);
        check_magnitude(start, "seed");
        const double theta = heading_of(robot, start.data);
        PathProblem problem = make_problem(robot,
                                           {frame, base_radius, obstacles, spheres, max_joint_step,
                                            joint_weights, jacobian, dexterity_weight},
                                           static_cast<int>(goals.size()));
        read_base_path(base_path, theta, problem, goals);
        const Heading window = Heading::read(heading, problem, theta);
        for (PathGoal& goal : goals) {
          window.apply(goal);
        }
        const std::vector<JointVector> warm = read_warm_start(warm_start, robot);
        const JointVector q = vector_at(start, 0);
        PathPlan plan;
        {
          const py::gil_scoped_release release;
          plan = plan_path(problem, goals, q, warm, options);
        }
        return to_python(py::cast(&robot, py::return_value_policy::reference), plan);
      },
      py::arg("robot"), py::arg("poses"), py::kw_only(), py::arg("seed"), py::arg("frame") = none,
      py::arg("base_path") = none, py::arg("base_radius") = none, py::arg("heading") = none,
      py::arg("obstacles") = py::tuple(), py::arg("spheres") = none,
      py::arg("method") = to_string(defaults.method), py::arg("max_joint_step") = none,
      py::arg("joint_weights") = none, py::arg("jacobian") = "whole_body",
      py::arg("dexterity_weight") = none, py::arg("warm_start") = none,
      py::arg("max_iterations") = defaults.max_iterations,
      py::arg("position_tolerance") = defaults.position_tolerance,
      py::arg("rotation_tolerance") = defaults.rotation_tolerance,
      py::arg("constraint_tolerance") = defaults.constraint_tolerance,
      R"(Configurations that take a frame along a path of poses, the whole body at once.

method='sqp' minimizes

    sum_k |W (q[k+1] - q[k])|^2 / 2  +  w sum_k log sqrt(kappa/M)(q[k])

with the joint weights W, the dexterity weight w and sqrt(kappa/M) of (4.33), subject to every pose,
the base within base_radius of the base path, theta within its window, obstacles kept clear of at
the waypoints and everywhere on the straight lines in joint space between them, joint limits and
max_joint_step. It is one sequential quadratic program over all waypoints in the null spaces of
their Jacobians, with exact second derivatives; time grows with the number of waypoints, not its
square. A local optimum, begun on each side of the Discs that the base path runs through until one
succeeds.

method='task_priority' goes from pose to pose, hand first, base second, [M17] (4.18), each iterated
until it rests, within the joints' limits; all else is only checked.

q[0] is the seed where that solves the first pose; else it is near the solution nearest to the seed,
and the way from the seed to it counts like a step.

Never raises because there is no such path: the plan says which waypoint can't be followed first,
what fails there, and by how much.

Parameters
----------
robot : Chain
    Of at least six joints.
poses : (N, 4, 4)
    Of the frame, in the root.
seed : (n,), rad and m
    Where the robot stands.
frame : str or int, optional
    Default the last.
base_path : (N, 2) or (N, 3), optional
    x, y (m) and theta (rad) of the base. Without base_radius it guides only.
base_radius : float > 0, optional
    m, how far from the base path the base may be.
heading : float or (2,), optional
    rad: how far theta may be from the base path's, or (lower, upper). theta goes on beyond pi: the
    window is meant up to whole turns and may cross +-pi.
obstacles : list of Disc, Sphere, Capsule, Box, HalfSpace
    A Disc keeps the base away, the others the spheres.
spheres : LinkSpheres, optional
    The robot's shape, with the pairs that must not meet.
method : str
    'sqp' or 'task_priority'.
max_joint_step : float or (n,), optional
    rad and m, between neighboring waypoints.
joint_weights : float or (n,), optional
    W; default ones.
jacobian : str or (n,)
    Whose dexterity: 'whole_body'; 'arm', which the base's columns do not help; or a weight for each
    joint's column. The whole body's is blind to singular arms.
dexterity_weight : float, optional
    w; default 1/N^2, with which the balance does not depend on how finely a path is sampled.
warm_start : (N, n) or PathPlan, optional
    Where to begin: the plan of a similar path.
max_iterations : int
    Of each attempt ('sqp') or each waypoint ('task_priority').
position_tolerance, rotation_tolerance, constraint_tolerance : float
    m, rad and both: what is missed by more is no success. 'sqp' ends far below.

Returns
-------
PathPlan

Raises
------
ValueError
    If an argument does not fit the robot or another one, or is not finite.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
>>> poses = np.repeat(robot.fk(seed)[None], 20, axis=0)
>>> poses[:, 0, 3] += np.linspace(0.0, 2.0, 20)
>>> path = tk.plan_path(robot, poses, seed=seed, obstacles=[tk.Disc((1.0, 0.3), 0.5)])
>>> path.success, path.q.shape
(True, (20, 9))
)");
}

}  // namespace thing_kin::python
