#include "thing_kin/kinematics/link_spheres.hpp"

#include <optional>

#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "map.hpp"
#include "model/chain.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/posture.hpp"

namespace thing_kin::python {

namespace {

std::string numbered(const char* name, std::size_t i) {
  return std::string(name).append("[").append(std::to_string(i)).append("]");
}

py::sequence read_sequence(const py::handle& argument, const std::string& name,
                           std::optional<std::size_t> length, const char* expected) {
  if (py::isinstance<py::sequence>(argument) && !py::isinstance<py::str>(argument)) {
    auto sequence = py::reinterpret_borrow<py::sequence>(argument);
    if (!length || sequence.size() == *length) {
      return sequence;
    }
  }
  throw InvalidArgument(name, py::repr(argument), expected);
}

LinkSphere read_sphere(const Chain& robot, const py::handle& entry, std::size_t i) {
  const std::string name = numbered("spheres", i);
  const py::sequence parts = read_sequence(entry, name, 3, "(frame, center, radius)");
  const int frame = read_frame(robot, parts[0], name.c_str());
  const Batch center = read(parts[1], name.c_str(), {3}, false);
  const Batch radius = read(parts[2], name.c_str(), {}, false);
  return {robot.frames()[static_cast<std::size_t>(frame)].name, vector_at(center, 0), *radius.data};
}

std::pair<int, int> read_pair(const py::handle& entry, std::size_t i) {
  const std::string name = numbered("pairs", i);
  const py::sequence two = read_sequence(entry, name, 2, "two indices of spheres");
  try {
    return {two[0].cast<int>(), two[1].cast<int>()};
  } catch (const py::cast_error&) {
    throw InvalidArgument(name, py::repr(entry), "two indices of spheres");
  }
}

LinkSpheres make_spheres(const Chain& robot, const py::object& spheres, const py::object& pairs) {
  LinkSpheres shape;
  for (const py::handle entry :
       read_sequence(spheres, "spheres", {}, "a list of (frame, center, radius)")) {
    shape.spheres.push_back(read_sphere(robot, entry, shape.spheres.size()));
  }
  if (pairs.is_none()) {
    shape.pairs = self_collision_pairs(robot, shape.spheres);
  } else {
    for (const py::handle entry : read_sequence(pairs, "pairs", {}, "a list of pairs of indices")) {
      shape.pairs.push_back(read_pair(entry, shape.pairs.size()));
    }
  }
  check(robot, shape);
  return shape;
}

py::tuple spheres_of(const LinkSpheres& shape) {
  py::list spheres;
  for (const auto& [frame, center, radius] : shape.spheres) {
    spheres.append(py::make_tuple(frame, py::make_tuple(center[0], center[1], center[2]), radius));
  }
  return py::tuple(spheres);
}

py::tuple pairs_of(const LinkSpheres& shape) { return py::tuple(py::cast(shape.pairs)); }

LinkSpheres from_state(const py::tuple& state) {
  LinkSpheres shape;
  for (const py::handle entry : state[0]) {
    const auto parts = entry.cast<py::tuple>();
    const auto center = parts[1].cast<std::array<double, 3>>();
    shape.spheres.push_back({parts[0].cast<std::string>(),
                             Eigen::Vector3d(center[0], center[1], center[2]),
                             parts[2].cast<double>()});
  }
  shape.pairs = state[1].cast<std::vector<std::pair<int, int>>>();
  return shape;
}

Array centers(const LinkSpheres& shape, const Chain& robot, const ArrayLike& q) {
  check(robot, shape);
  std::vector<int> frames;
  frames.reserve(shape.spheres.size());
  for (const LinkSphere& sphere : shape.spheres) {
    frames.push_back(robot.frame_index(sphere.frame));
  }
  const Batch batch = read_vectors(q, "q", robot.dof());
  const auto count = static_cast<py::ssize_t>(frames.size());
  return map(batch, {count, 3}, [&](const double* at, double* out) {
    Posture posture;
    place_joints(robot, at, posture);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      Eigen::Map<Eigen::Vector3d>{out + 3 * i} =
          frame_pose(robot, posture, frames[i]) * shape.spheres[i].center;
    }
  });
}

}  // namespace

void bind_link_spheres(py::module_& m) {
  py::class_<LinkSpheres>(m, "LinkSpheres",
                          R"(A robot's shape as balls fixed to its frames, for clearances.

Immutable. The frames are kept by name: the same shape serves the robot with other limits or a
further tool.

Parameters
----------
robot : Chain
spheres : sequence of (frame, center, radius)
    A frame's name or index, coordinates in it (3,), m, and m.
pairs : sequence of (int, int), optional
    Which spheres must not meet each other, by their places in `spheres`. Default: all, but of one
    link or neighboring links; of those that cannot meet, by the triangle inequality over the links
    between them; and of those that overlap in a quarter or more of 256 postures spread within the
    limits, too near each other along the chain for balls to tell.

Raises
------
ValueError
    If a frame does not exist, a radius is not positive, an index is none, or a number not finite.

Examples
--------
>>> import thing_kin as tk
>>> robot = tk.robots.ur10()
>>> shape = tk.LinkSpheres(robot, [("tool", (0, 0, 0.05), 0.1), ("upper_arm", (0.3, 0, 0), 0.1)])
>>> shape.pairs
((0, 1),)
)")
      .def(py::init(&make_spheres), py::arg("robot"), py::arg("spheres"), py::kw_only(),
           py::arg("pairs") = py::none())
      .def_static(
          "along_links",
          [](const Chain& robot, double radius, std::optional<double> spacing) {
            LinkSpheres shape = spheres_along_links(robot, radius, spacing.value_or(radius));
            shape.pairs = self_collision_pairs(robot, shape.spheres);
            return shape;
          },
          py::arg("robot"), py::arg("radius"), py::arg("spacing") = py::none(),
          R"(Balls of one radius along the arm, from each joint's frame straight to the next.

The last link ends at the tool. What a base carries below the arm's first joint is left out: that
is a Disc's concern, or that of further spheres. Neighboring centers are at most `spacing` apart;
the default, one radius, leaves notches of 13 % of it between the balls.

Parameters
----------
robot : Chain
radius : float, m
spacing : float, m, optional
    At least 0.001; default: the radius.

Returns
-------
LinkSpheres
    With the default pairs.

Raises
------
ValueError
    If the radius is not positive, or the spacing too small.

Examples
--------
>>> import thing_kin as tk
>>> tk.LinkSpheres.along_links(tk.robots.ur10(), radius=0.08, spacing=0.15)
LinkSpheres(15 spheres, 33 pairs)
)")
      .def_property_readonly("spheres", &spheres_of, "(frame, (x, y, z), radius) each, m.")
      .def_property_readonly("pairs", &pairs_of, "Pairs of spheres that must not meet.")
      .def("centers", &centers, py::arg("robot"), py::arg("q"), R"(Where the spheres' centers are.

Parameters
----------
robot : Chain
q : (n,) or (N, n), rad and m

Returns
-------
(S, 3) or (N, S, 3), m

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.ur10()
>>> shape = tk.LinkSpheres(robot, [("tool", (0, 0, 0), 0.1)])
>>> np.allclose(shape.centers(robot, np.zeros(6))[0], robot.fk(np.zeros(6))[:3, 3])
True
)")
      .def("__len__", [](const LinkSpheres& shape) { return shape.spheres.size(); })
      .def(py::self == py::self)
      .def("__hash__",
           [](const LinkSpheres& shape) {
             return py::hash(py::make_tuple(spheres_of(shape), pairs_of(shape)));
           })
      .def(py::pickle(
          [](const LinkSpheres& shape) {
            return py::make_tuple(spheres_of(shape), pairs_of(shape));
          },
          &from_state))
      .def("__repr__", [](const LinkSpheres& shape) {
        return py::str("LinkSpheres({} spheres, {} pairs)")
            .format(shape.spheres.size(), shape.pairs.size());
      });
}

}  // namespace thing_kin::python
