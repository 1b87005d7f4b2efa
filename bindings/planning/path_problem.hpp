#pragma once

#include <optional>
#include <vector>

#include "array.hpp"
#include "column_weights.hpp"
#include "model/chain.hpp"
#include "model/obstacle.hpp"
#include "thing_kin/planning/path_problem.hpp"

namespace thing_kin::python {

/// LinkSpheres or None.
class SpheresLike : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(SpheresLike, object, [](PyObject*) { return 1; })
};

/// How Python states what is the same at all waypoints.
struct PathArguments {
  const FrameLike& frame;
  std::optional<double> base_radius;
  const ObstacleList& obstacles;
  const SpheresLike& spheres;
  const OptionalArray& max_joint_step;
  const OptionalArray& joint_weights;
  const JacobianColumns& jacobian;
  std::optional<double> dexterity_weight;
};

/// waypoints: how many the default of the dexterity weight is for. Throws InvalidArgument.
PathProblem make_problem(const Chain& robot, const PathArguments& arguments, int waypoints);

/// A window for theta: as given, or so much to each side of the base path's.
struct Heading {
  bool given = false;
  bool about_path = false;
  double lower = -kUnlimited;
  double upper = kUnlimited;

  /// None, a number or two of them; `theta` is where the robot stands.
  static Heading read(const OptionalArray& argument, const PathProblem& problem, double theta);
  void apply(PathGoal& goal) const;
};

/// (4, 4) row-major to a goal's pose, its rotation made orthonormal.
SE3 read_goal_pose(const double* row_major, const char* name);

/// theta of the robot as it stands in q; 0 without a base.
double heading_of(const Chain& robot, const double* q);

/// The image of an angle by whole turns that is nearest to another.
double nearest_turn(double angle, double to);

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::SpheresLike> {
  static constexpr auto name = const_name("thing_kin._core.LinkSpheres | None");
};

}  // namespace pybind11::detail
