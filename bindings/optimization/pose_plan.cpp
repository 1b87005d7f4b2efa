#include "thing_kin/optimization/pose_plan.hpp"

#include <optional>

#include <pybind11/stl.h>

#include "array.hpp"
#include "bindings.hpp"
#include "column_weights.hpp"
#include "model/chain.hpp"
#include "model/obstacle.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

struct ExplainedPlan {
  PosePlan plan;
  std::string message;
};

// A planner with the Python object of its chain, which it refers to.
struct BoundPlanner {
  py::object chain;
  PosePlanner planner;
};

bool search_from_string(const std::string& name) {
  if (name == "local" || name == "global") {
    return name == "global";
  }
  throw InvalidArgument("search", quoted(name), "'local' or 'global'");
}

std::optional<std::array<double, 2>> read_pair(const OptionalArray& argument, const char* name) {
  if (argument.is_none()) {
    return std::nullopt;
  }
  const Batch numbers = read(argument, name, {2}, false);
  return std::array<double, 2>{numbers.data[0], numbers.data[1]};
}

// Obstacles that are not discs concern the robot's shape, which nobody but the user knows.
void check_spheres(const std::optional<LinkSpheres>& spheres,
                   const std::vector<Obstacle>& obstacles) {
  for (const Obstacle& obstacle : obstacles) {
    if (!spheres && !std::holds_alternative<Disc>(obstacle)) {
      throw InvalidArgument("spheres", "None",
                            "a LinkSpheres, since there are obstacles other than discs");
    }
  }
}

// The planner of one call in the order of the arguments below.
BoundPlanner make(const Chain& robot, const OptionalArray& base_goal,
                  std::optional<double> base_radius, const OptionalArray& heading,
                  const ObstacleList& obstacles, const std::optional<LinkSpheres>& spheres,
                  const JacobianColumns& jacobian, const FrameLike& frame,
                  const std::string& search, int max_iterations, int max_restarts, int samples,
                  int descents, double tolerance, std::uint64_t rng) {
  PosePlanOptions options;
  if (const auto goal = read_pair(base_goal, "base_goal")) {
    options.base_goal = Eigen::Vector2d((*goal)[0], (*goal)[1]);
    if (!base_radius) {
      throw InvalidArgument("base_radius", "None", "a radius about base_goal, m");
    }
  } else if (base_radius) {
    throw InvalidArgument("base_goal", "None", "the middle of the disc of base_radius");
  }
  options.base_radius = base_radius.value_or(0.0);
  options.heading = read_pair(heading, "heading");
  options.column_weights = read_column_weights(jacobian, robot);
  options.global = search_from_string(search);
  options.max_iterations = max_iterations;
  options.max_restarts = max_restarts;
  options.samples = samples;
  options.descents = descents;
  options.tolerance = tolerance;
  options.rng = rng;
  std::vector<Obstacle> shapes = read_obstacles(obstacles, "obstacles");
  check_spheres(spheres, shapes);
  return {py::cast(&robot, py::return_value_policy::reference),
          PosePlanner(robot, read_frame(robot, frame, "frame"), options,
                      spheres.value_or(LinkSpheres{}), std::move(shapes))};
}

py::object solve_pose(const BoundPlanner& bound, const ArrayLike& target,
                      const OptionalArray& seed) {
  const Batch pose = read(target, "target", {4, 4}, false);
  check_magnitude(pose, "target");
  const SE3 T = read_pose(pose.data, "target");
  JointVector start = JointVector::Zero(bound.planner.chain().dof());
  if (!seed.is_none()) {
    const Batch numbers = read(seed, "seed", {bound.planner.chain().dof()}, false);
    check_magnitude(numbers, "seed");
    start = vector_at(numbers, 0);
  }
  ExplainedPlan out;
  {
    const py::gil_scoped_release release;
    out.plan = bound.planner.solve(T, start.data());
  }
  out.message = message(bound.planner, out.plan);
  return py::cast(std::move(out));
}

void bind_pose_result(py::module_& m) {
  const auto number = [](auto PosePlan::*field) {
    return [field](const ExplainedPlan& p) { return p.plan.*field; };
  };
  py::class_<ExplainedPlan>(m, "PosePlan", R"(What plan_pose found, and why not more.

q is always finite and within joint limits, also without success: then it is the best found.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> plan = tk.plan_pose(robot, tk.transform(xyz=(9.0, 0.0, 1.0)), base_goal=(0, 0), base_radius=0.5)
>>> plan.success, plan.status
(False, 'infeasible')
)")
      .def_property_readonly(
          "q", [](const ExplainedPlan& p) { return Array(p.plan.q.size(), p.plan.q.data()); },
          "(n,), rad and m.")
      .def_property_readonly(
          "success", [](const ExplainedPlan& p) { return p.plan.success(); },
          "Whether q is a local optimum that keeps all constraints, by forward kinematics of q.")
      .def_property_readonly(
          "status", [](const ExplainedPlan& p) { return to_string(p.plan.status); },
          R"(How it ended.

'converged': feasible and stationary. 'infeasible': every descent ended with constraints
violated. 'budget': iterations ran out.)")
      .def_property_readonly(
          "message", [](const ExplainedPlan& p) { return p.message; },
          "In a sentence: what is violated most, and by how much.")
      .def_property_readonly("objective", number(&PosePlan::objective),
                             "sqrt(kappa/M) at q, [M17] (4.33).")
      .def_property_readonly("constraint_violation", number(&PosePlan::constraint_violation),
                             "The largest of all constraints, m or rad.")
      .def_property_readonly("position_error", number(&PosePlan::position_error),
                             "Distance of the hand from the target, m.")
      .def_property_readonly("rotation_error", number(&PosePlan::rotation_error),
                             "Angle between the hand and the target, rad.")
      .def_property_readonly("iterations", number(&PosePlan::iterations),
                             "Quadratic programs of all descents.")
      .def_property_readonly("restarts", number(&PosePlan::restarts), "Descents beside the seed's.")
      .def_property_readonly("time", number(&PosePlan::time), "s, inside the solver.")
      .def("__repr__", [](const ExplainedPlan& p) {
        return py::str("PosePlan({}, objective={:.4f}, {} iterations, {} restarts)")
            .format(p.message, p.plan.objective, p.plan.iterations, p.plan.restarts);
      });
}

}  // namespace

void bind_pose_plan(py::module_& m) {
  bind_pose_result(m);
  const PosePlanOptions defaults;
  const auto none = py::none();
  const auto options = [&](auto&& define) {
    define(py::arg("base_goal") = none, py::arg("base_radius") = none, py::arg("heading") = none,
           py::arg("obstacles") = py::tuple(), py::arg("spheres") = none,
           py::arg("jacobian") = "whole_body", py::arg("frame") = none, py::arg("search") = "local",
           py::arg("max_iterations") = defaults.max_iterations,
           py::arg("max_restarts") = defaults.max_restarts, py::arg("samples") = defaults.samples,
           py::arg("descents") = defaults.descents, py::arg("tolerance") = defaults.tolerance,
           py::arg("rng") = defaults.rng);
  };

  py::class_<BoundPlanner> planner(m, "PosePlanner",
                                   R"(Finds dexterous whole-body poses, [M17] (4.34).

Least sqrt(kappa/M) over the configurations that have the hand at the target, the base within a disc
about its goal and in a window of heading, the joints within limits, and that keep clear of
obstacles. The pose's six equations are eliminated: each step is one in the null space of the
Jacobian, of a quadratic program with the exact second derivatives of log sqrt(kappa/M), in a trust
region; then the hand is brought back. Where the seed's descent fails, others begin at solutions of
inverse kinematics for base placements within the disc.

Whole-body dexterity is blind to singularities of the arm, since the base fills the lost direction:
jacobian='arm' sees them.

Immutable: any number of threads may share one.

Parameters
----------
robot : Chain
    At least six joints.
base_goal : (2,), optional
    Where the base should be, m.
base_radius : float > 0, optional
    How far from there it may be, m.
heading : (2,), optional
    Least and greatest theta, rad, taken as given: theta is continuous, a window may cross pi.
obstacles : sequence of Disc, Sphere, Capsule, Box, HalfSpace
    A Disc keeps the base's reference point out, (4.29); the others the balls of `spheres`.
spheres : LinkSpheres, optional
    The robot's shape; its pairs must not meet. Needed for obstacles other than discs.
jacobian : str or (n,)
    Whose dexterity counts: 'whole_body', 'arm' (without the base's columns), or weights of the
    columns, 0 to 1e6.
frame : str or int, optional
    The frame that is to reach the target; default the last.
search : str
    'local': the optimum that the seed's descent leads to. 'global': the best of all arm branches
    and base placements, by descents from the best of many samples.
max_iterations : int
    Of one descent.
max_restarts : int
    Of a local search, where the seed's descent fails.
samples, descents : int
    Of a global search: base placements, and how many of the best begin a descent.
tolerance : float > 0
    A constraint violated by less is kept, m and rad.
rng : int
    Which base placements are tried.

Raises
------
ValueError
    If an option does not fit the robot.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> planner = tk.PosePlanner(robot, base_goal=(0.6, 0.0), base_radius=0.3)
>>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
>>> plan = planner.solve(tk.transform(xyz=(1.2, -0.9, 0.9), rpy=(0.0, np.pi / 2, 0.0)), seed)
>>> plan.success, bool(np.hypot(*(robot.base_pose(plan.q)[:2] - (0.6, 0.0))) <= 0.3 + 1e-8)
(True, True)
)");
  options([&](auto&&... extra) {
    planner.def(py::init(&make), py::arg("robot"), py::kw_only(), extra...);
  });
  planner
      .def("solve", &solve_pose, py::arg("target"), py::arg("seed") = none,
           R"(Solves for one target.

Parameters
----------
target : (4, 4)
    In the root.
seed : (n,), optional
    Where to begin; brought into the limits first. Default zeros.

Returns
-------
PosePlan

Raises
------
ValueError
    If a shape does not fit, a number is not finite or the pose is not rigid.

Examples
--------
>>> import thing_kin as tk
>>> robot = tk.robots.thing()
>>> tk.PosePlanner(robot, jacobian="arm").solve(tk.transform(xyz=(1.0, 0.5, 0.9))).success
True
)")
      .def_property_readonly(
          "robot", [](const BoundPlanner& p) { return p.chain; }, "The robot.")
      .def("__repr__", [](const BoundPlanner& p) {
        return py::str("PosePlanner({!r})").format(p.planner.chain().name());
      });

  options([&](auto&&... extra) {
    m.def(
        "plan_pose",
        [](const Chain& robot, const ArrayLike& target, const OptionalArray& seed,
           const OptionalArray& base_goal, std::optional<double> base_radius,
           const OptionalArray& heading, const ObstacleList& obstacles,
           const std::optional<LinkSpheres>& spheres, const JacobianColumns& jacobian,
           const FrameLike& frame, const std::string& search, int max_iterations, int max_restarts,
           int samples, int descents, double tolerance, std::uint64_t rng) {
          const BoundPlanner bound =
              make(robot, base_goal, base_radius, heading, obstacles, spheres, jacobian, frame,
                   search, max_iterations, max_restarts, samples, descents, tolerance, rng);
          return solve_pose(bound, target, seed);
        },
        py::arg("robot"), py::arg("target"), py::arg("seed") = none, py::kw_only(), extra...,
        R"(The whole-body pose of least sqrt(kappa/M) for a target, [M17] (4.34).

Never raises because there is none: the result says why.

Parameters
----------
robot : Chain
    At least six joints.
target : (4, 4)
    Pose of the frame, in the root.
seed : (n,), optional
    Where to begin; brought into the limits first. Default zeros.
base_goal, base_radius, heading, obstacles, spheres, jacobian, frame, search, max_iterations, max_restarts, samples, descents, tolerance, rng
    See PosePlanner.

Returns
-------
PosePlan

Raises
------
ValueError
    If an argument does not fit the robot.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> T_goal = tk.transform(xyz=(1.2, -0.9, 0.9), rpy=(0.0, np.pi / 2, 0.0))
>>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
>>> wall = tk.Disc(center=(0.6, 0.6), radius=0.4)
>>> plan = tk.plan_pose(robot, T_goal, seed=seed, base_goal=(0.6, 0.0), base_radius=0.3,
...                     heading=(-0.8, 0.8), obstacles=[wall])
>>> plan.success, bool(np.allclose(robot.fk(plan.q), T_goal, atol=1e-8))
(True, True)
)");
  });
}

}  // namespace thing_kin::python
