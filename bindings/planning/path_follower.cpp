#include "thing_kin/planning/path_follower.hpp"

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "map.hpp"
#include "planning/path_problem.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

// A follower with the Python object of its robot, which it refers to, and how it reads goals.
struct BoundFollower {
  py::object robot;
  PathFollower follower;
  Heading heading;
  double theta;  // of the last waypoint's base

  PathGoal read_goal(const ArrayLike& pose, const OptionalArray& base) {
    const PathProblem& problem = follower.problem();
    PathGoal goal;
    goal.pose = read_goal_pose(read(pose, "pose", {4, 4}, false).data, "pose");
    if (problem.has_base_path) {
      const Batch row = read(base, "base", {problem.has_base_heading ? 3 : 2}, false);
      theta = problem.has_base_heading ? nearest_turn(row.data[2], theta) : theta;
      goal.base << row.data[0], row.data[1], theta;
    } else if (!base.is_none()) {
      throw InvalidArgument("base", "an array", "None, as the follower was made without a base");
    }
    heading.apply(goal);
    return goal;
  }
};

struct Base {
  bool path, heading;
};

Base read_base(const std::string& name, const Chain& robot) {
  if (name == "free") {
    return {false, false};
  }
  if (name != "xy" && name != "xytheta") {
    throw InvalidArgument("base", quoted(name), "'free', 'xy' or 'xytheta'");
  }
  check_omni_base(robot);
  return {true, name == "xytheta"};
}

}  // namespace

void bind_path_follower(py::module_& m) {
  const auto none = py::none();
  py::class_<FollowerStep>(m, "FollowerStep", R"(One step of a PathFollower.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
>>> follower = tk.PathFollower(robot, seed, window=10)
>>> follower.push(robot.fk(seed))
True
>>> step = follower.step()
>>> step.q.shape, step.position_error < 1e-9
((9,), True)
)")
      .def_property_readonly(
          "q", [](const FollowerStep& s) { return Array(s.q.size(), s.q.data()); },
          "(n,), rad and m: where to go next.")
      .def_readonly("position_error", &FollowerStep::position_error, "m, by forward kinematics.")
      .def_readonly("rotation_error", &FollowerStep::rotation_error, "rad.")
      .def_readonly("violation", &FollowerStep::violation,
                    "Largest of the constraints of q and of the way to it, m or rad.")
      .def_readonly("settled", &FollowerStep::settled, "Whether the window was at its optimum.")
      .def("__repr__", [](const FollowerStep& s) {
        return py::str("FollowerStep(violation={:.1e}, settled={})").format(s.violation, s.settled);
      });

  py::class_<BoundFollower>(m, "PathFollower", R"(plan_path for poses that come in one by one.

A window of waypoints is kept optimized with one iteration a step, each warm from the one before;
the window's first configuration goes out. The objective and the constraints are plan_path's. In a
step's C++ nothing allocates.

Parameters
----------
robot : Chain
seed : (n,), rad and m
    Where the robot stands.
window : int
    How many waypoints to look ahead.
base : str
    What comes with each pose of the base: nothing ('free'), 'xy' or 'xytheta'.
frame, base_radius, heading, obstacles, spheres, max_joint_step, joint_weights, jacobian
    See plan_path.
dexterity_weight : float, optional
    Default 1/window^2.

Raises
------
ValueError
    If an argument does not fit the robot.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
>>> follower = tk.PathFollower(robot, seed, window=10)
>>> pose = robot.fk(seed)
>>> for _ in range(10):  # fill the window, then give and take one by one
...     pose[0, 3] += 0.02
...     assert follower.push(pose)
>>> pose[0, 3] += 0.02
>>> step = follower.step()
>>> follower.push(pose), step.position_error < 1e-9
(True, True)
)")
      .def(py::init([](const Chain& robot, const ArrayLike& seed, int window,
                       const std::string& base, const FrameLike& frame,
                       std::optional<double> base_radius, const OptionalArray& heading,
                       const ObstacleList& obstacles, const SpheresLike& spheres,
                       const OptionalArray& max_joint_step, const OptionalArray& joint_weights,
                       const JacobianColumns& jacobian, std::optional<double> dexterity_weight) {
             const Batch start = read(seed, "seed", {robot.dof()}, false);
             check_magnitude(start, "seed");
             const double theta = heading_of(robot, start.data);
             const auto [path, with_heading] = read_base(base, robot);
             PathProblem problem =
                 make_problem(robot,
                              {frame, base_radius, obstacles, spheres, max_joint_step,
                               joint_weights, jacobian, dexterity_weight},
                              window);
             problem.has_base_path = path;
             problem.has_base_heading = with_heading;
             if (!path && base_radius) {
               throw InvalidArgument("base_radius", text(*base_radius), "None with base='free'");
             }
             const Heading limits = Heading::read(heading, problem, theta);
             return std::make_unique<BoundFollower>(BoundFollower{
                 py::cast(&robot, py::return_value_policy::reference),
                 PathFollower(std::move(problem), window, vector_at(start, 0)), limits, theta});
           }),
           py::arg("robot"), py::arg("seed"), py::kw_only(), py::arg("window") = 20,
           py::arg("base") = "free", py::arg("frame") = none, py::arg("base_radius") = none,
           py::arg("heading") = none, py::arg("obstacles") = py::tuple(), py::arg("spheres") = none,
           py::arg("max_joint_step") = none, py::arg("joint_weights") = none,
           py::arg("jacobian") = "whole_body", py::arg("dexterity_weight") = none)
      .def(
          "push",
          [](BoundFollower& self, const ArrayLike& pose, const OptionalArray& base) {
            return self.follower.push(self.read_goal(pose, base));
          },
          py::arg("pose"), py::arg("base") = none, R"(Appends a waypoint to the window.

Parameters
----------
pose : (4, 4)
base : (2,) or (3,), optional
    x, y (m) and theta (rad) of the base path there, as the follower was told.

Returns
-------
bool
    False, and nothing changes, if the window is full or the pose can't be reached from the one
    before it.

Raises
------
ValueError
    If a shape does not fit or a number is not finite.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
>>> follower = tk.PathFollower(robot, seed, window=10)
>>> follower.push(robot.fk(seed)), follower.pending
(True, 1)
)")
      .def(
          "step",
          [](BoundFollower& self) -> std::optional<FollowerStep> {
            FollowerStep step;
            const bool moved = self.follower.step(step);
            return moved ? std::optional(step) : std::nullopt;
          },
          R"(One iteration on the window, whose first waypoint goes out.

That is where the robot stands from now on.

Returns
-------
FollowerStep or None
    None if the window is empty.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
>>> follower = tk.PathFollower(robot, seed, window=10)
>>> follower.step() is None
True
>>> follower.push(robot.fk(seed)), follower.step().position_error < 1e-9
(True, True)
)")
      .def_property_readonly(
          "robot", [](const BoundFollower& self) { return self.robot; }, "The robot.")
      .def_property_readonly(
          "pending", [](const BoundFollower& self) { return self.follower.pending(); },
          "How many waypoints are in the window.")
      .def_property_readonly(
          "window", [](const BoundFollower& self) { return self.follower.window(); },
          "How many it has room for.")
      .def("__repr__", [](const BoundFollower& self) {
        return py::str("PathFollower({} of {} waypoints)")
            .format(self.follower.pending(), self.follower.window());
      });
}

}  // namespace thing_kin::python
