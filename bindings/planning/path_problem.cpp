#include "planning/path_problem.hpp"

#include <cmath>
#include <numbers>

#include "thing_kin/core/error.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin::python {

namespace {

JointVector read_positive(const OptionalArray& argument, const char* name, int n, double otherwise,
                          Finite finite) {
  if (argument.is_none()) {
    return JointVector::Constant(n, otherwise);
  }
  const JointVector values = read_number_or_vector(argument, name, n, finite);
  for (const double value : values) {
    if (!(value > 0.0)) {
      throw InvalidArgument(name, text(value), "numbers > 0");
    }
  }
  return values;
}

bool is_number(const py::object& argument) {
  return PyFloat_Check(argument.ptr()) != 0 || PyLong_Check(argument.ptr()) != 0 ||
         (py::hasattr(argument, "ndim") && argument.attr("ndim").cast<int>() == 0);
}

LinkSpheres read_spheres(const SpheresLike& argument, const std::vector<Obstacle>& obstacles) {
  if (!argument.is_none()) {
    if (!py::isinstance<LinkSpheres>(argument)) {
      throw InvalidArgument("spheres", py::str(py::type::of(argument).attr("__name__")),
                            "LinkSpheres or None");
    }
    return argument.cast<LinkSpheres>();
  }
  for (const Obstacle& obstacle : obstacles) {
    if (!std::holds_alternative<Disc>(obstacle)) {
      throw InvalidArgument("spheres", "None",
                            "LinkSpheres, which obstacles other than Disc keep away from");
    }
  }
  return {};
}

}  // namespace

PathProblem make_problem(const Chain& robot, const PathArguments& arguments, int waypoints) {
  std::vector<Obstacle> obstacles = read_obstacles(arguments.obstacles, "obstacles");
  LinkSpheres spheres = read_spheres(arguments.spheres, obstacles);
  PathProblem problem(robot, read_frame(robot, arguments.frame, "frame"), std::move(obstacles),
                      std::move(spheres));
  problem.base_radius = arguments.base_radius.value_or(kUnlimited);
  if (!(problem.base_radius > 0.0)) {
    throw InvalidArgument("base_radius", text(problem.base_radius), "a number > 0 or None");
  }
  problem.max_joint_step = read_positive(arguments.max_joint_step, "max_joint_step", robot.dof(),
                                         kUnlimited, Finite::kNo);
  problem.joint_weights =
      read_positive(arguments.joint_weights, "joint_weights", robot.dof(), 1.0, Finite::kYes);
  const JointVector columns = read_column_weights(arguments.jacobian, robot);
  if (columns.size() > 0) {
    problem.column_weights = columns;
  }
  const double count = std::max(1, waypoints);
  problem.dexterity_weight = arguments.dexterity_weight.value_or(1.0 / (count * count));
  if (!(problem.dexterity_weight >= 0.0 && std::isfinite(problem.dexterity_weight))) {
    throw InvalidArgument("dexterity_weight", text(problem.dexterity_weight), "a number >= 0");
  }
  return problem;
}

double nearest_turn(double angle, double to) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return angle + kTurn * std::round((to - angle) / kTurn);
}

double heading_of(const Chain& robot, const double* q) {
  return robot.base_joints() ? q[(*robot.base_joints())[2]] : 0.0;
}

Heading Heading::read(const OptionalArray& argument, const PathProblem& problem, double theta) {
  Heading heading;
  if (argument.is_none()) {
    return heading;
  }
  check_omni_base(problem.chain());
  heading.given = true;
  if (is_number(argument)) {
    const double half = *python::read(argument, "heading", {}, false).data;
    if (!(half >= 0.0)) {
      throw InvalidArgument("heading", text(half), "a number >= 0, rad");
    }
    if (!problem.has_base_heading) {
      throw InvalidArgument("heading", text(half),
                            "(lower, upper), or a base_path with theta to be about");
    }
    heading.about_path = true;
    heading.lower = -half;
    heading.upper = half;
    return heading;
  }
  const Batch window = python::read(argument, "heading", {2}, false);
  heading.lower = window.data[0];
  heading.upper = window.data[1];
  if (!(heading.lower <= heading.upper)) {
    throw InvalidArgument("heading", text(heading.lower).append(" > ").append(text(heading.upper)),
                          "lower <= upper");
  }
  const double middle = 0.5 * (heading.lower + heading.upper);
  const double shift = nearest_turn(middle, theta) - middle;
  heading.lower += shift;
  heading.upper += shift;
  return heading;
}

void Heading::apply(PathGoal& goal) const {
  if (!given) {
    return;
  }
  const double about = about_path ? goal.base[2] : 0.0;
  goal.heading_lower = about + lower;
  goal.heading_upper = about + upper;
}

SE3 read_goal_pose(const double* row_major, const char* name) {
  SE3 pose = read_pose(row_major, name);
  pose.rotation = rotation_from_quaternion(quaternion_from_rotation(pose.rotation));
  return pose;
}

}  // namespace thing_kin::python
