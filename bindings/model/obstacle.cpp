#include "model/obstacle.hpp"

#include <optional>
#include <vector>

#include <pybind11/operators.h>

#include "bindings.hpp"
#include "map.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin::python {

namespace {

template <int n>
Eigen::Matrix<double, n, 1> read_point(py::handle argument, const char* name) {
  return Eigen::Map<const Eigen::Matrix<double, n, 1>>(read(argument, name, {n}, false).data);
}

template <typename Shape>
Shape checked(const Shape& shape) {
  check(shape);
  return shape;
}

// Whoever reads (0.6, 0.6) wants to see no array(...).
template <typename Vector>
py::tuple numbers(const Vector& vector) {
  py::tuple result(vector.size());
  for (Eigen::Index i = 0; i < vector.size(); ++i) {
    result[static_cast<std::size_t>(i)] = vector[i] + 0.0;  // -0 becomes 0
  }
  return result;
}

using State = std::vector<double>;

State to_state(const Disc& d) { return {d.center[0], d.center[1], d.radius}; }
State to_state(const Sphere& s) { return {s.center[0], s.center[1], s.center[2], s.radius}; }
State to_state(const Capsule& c) {
  return {c.start[0], c.start[1], c.start[2], c.end[0], c.end[1], c.end[2], c.radius};
}
State to_state(const Box& box) {
  State state(15);
  Eigen::Map<Eigen::Matrix3d>(state.data()) = box.pose.rotation;
  Eigen::Map<Eigen::Vector3d>(state.data() + 9) = box.pose.translation;
  Eigen::Map<Eigen::Vector3d>(state.data() + 12) = box.half_size;
  return state;
}
State to_state(const HalfSpace& h) { return {h.normal[0], h.normal[1], h.normal[2], h.offset}; }

void from_state(const double* s, Disc& disc) { disc = {{s[0], s[1]}, s[2]}; }
void from_state(const double* s, Sphere& sphere) { sphere = {{s[0], s[1], s[2]}, s[3]}; }
void from_state(const double* s, Capsule& capsule) {
  capsule = {{s[0], s[1], s[2]}, {s[3], s[4], s[5]}, s[6]};
}
void from_state(const double* s, Box& box) {
  box = {{Eigen::Map<const Eigen::Matrix3d>(s), Eigen::Map<const Eigen::Vector3d>(s + 9)},
         Eigen::Map<const Eigen::Vector3d>(s + 12)};
}
void from_state(const double* s, HalfSpace& half) { half = {{s[0], s[1], s[2]}, s[3]}; }

template <typename Shape>
py::tuple pickled(const Shape& shape) {
  return py::tuple(py::cast(to_state(shape)));
}

template <typename Shape>
Shape unpickled(const py::tuple& state) {
  Shape shape;
  const auto count = static_cast<py::ssize_t>(to_state(shape).size());
  from_state(read(state, "state", {count}, false).data, shape);
  return checked(shape);
}

template <typename Shape>
py::class_<Shape> bind_shape(py::module_& m, const char* name, const char* doc) {
  py::class_<Shape> shape(m, name, doc);
  shape.def(py::self == py::self)
      .def("__hash__", [](const Shape& self) { return py::hash(pickled(self)); })
      .def(py::pickle(&pickled<Shape>, &unpickled<Shape>))
      .def(
          "signed_distance",
          [](const Shape& self, const ArrayLike& points) {
            const Batch batch = read(points, "points", {3});
            check_magnitude(batch, "points");
            const Obstacle obstacle = self;
            return map_scalar(batch, [&](const double* p) {
              return signed_distance_value(obstacle, Eigen::Map<const Eigen::Vector3d>(p));
            });
          },
          py::arg("points"), R"(Distance of points from the surface, m; negative inside.

Parameters
----------
points : (3,) or (N, 3), m

Returns
-------
float or (N,)

Examples
--------
>>> import thing_kin as tk
>>> tk.Sphere(center=(0, 0, 1), radius=0.25).signed_distance([(0, 0, 1), (0, 3, 5)])
array([-0.25,  4.75])
)");
  return shape;
}

void bind_disc(py::module_& m) {
  bind_shape<Disc>(m, "Disc", R"(Keeps the base's reference point away, [M17] (4.29).

As an obstacle it is an upright cylinder without ends: heights do not count, and only the base is
concerned, not the arm above it.

Parameters
----------
center : (2,), m
radius : float, m

Raises
------
ValueError
    If the radius is not positive, or a number not finite.

Examples
--------
>>> import thing_kin as tk
>>> tk.Disc(center=(0.6, 0.6), radius=0.4)
Disc(center=(0.6, 0.6), radius=0.4)
)")
      .def(py::init([](const ArrayLike& center, double radius) {
             return checked(Disc{read_point<2>(center, "center"), radius});
           }),
           py::arg("center"), py::arg("radius"))
      .def_property_readonly(
          "center", [](const Disc& disc) { return frozen(disc.center); }, "(x, y), m.")
      .def_readonly("radius", &Disc::radius, "Its radius, m.")
      .def("__repr__", [](const Disc& disc) {
        return py::str("Disc(center={}, radius={})").format(numbers(disc.center), disc.radius);
      });
}

void bind_sphere(py::module_& m) {
  bind_shape<Sphere>(m, "Sphere", R"(A ball that the robot's spheres stay clear of.

Parameters
----------
center : (3,), m
radius : float, m

Raises
------
ValueError
    If the radius is not positive, or a number not finite.

Examples
--------
>>> import thing_kin as tk
>>> tk.Sphere(center=(1.0, 0.0, 0.8), radius=0.2)
Sphere(center=(1.0, 0.0, 0.8), radius=0.2)
)")
      .def(py::init([](const ArrayLike& center, double radius) {
             return checked(Sphere{read_point<3>(center, "center"), radius});
           }),
           py::arg("center"), py::arg("radius"))
      .def_property_readonly(
          "center", [](const Sphere& sphere) { return frozen(sphere.center); }, "(x, y, z), m.")
      .def_readonly("radius", &Sphere::radius, "Its radius, m.")
      .def("__repr__", [](const Sphere& sphere) {
        return py::str("Sphere(center={}, radius={})")
            .format(numbers(sphere.center), sphere.radius);
      });
}

void bind_capsule(py::module_& m) {
  bind_shape<Capsule>(m, "Capsule", R"(All points within a radius of a segment: a post, a pipe.

Parameters
----------
start, end : (3,), m
    Of the segment; equal ends make a sphere.
radius : float, m

Raises
------
ValueError
    If the radius is not positive, or a number not finite.

Examples
--------
>>> import thing_kin as tk
>>> post = tk.Capsule(start=(1, 0, 0), end=(1, 0, 2), radius=0.1)
>>> post.signed_distance((1.5, 0, 1))
0.4
)")
      .def(py::init([](const ArrayLike& start, const ArrayLike& end, double radius) {
             return checked(
                 Capsule{read_point<3>(start, "start"), read_point<3>(end, "end"), radius});
           }),
           py::arg("start"), py::arg("end"), py::arg("radius"))
      .def_property_readonly(
          "start", [](const Capsule& capsule) { return frozen(capsule.start); }, "(x, y, z), m.")
      .def_property_readonly(
          "end", [](const Capsule& capsule) { return frozen(capsule.end); }, "(x, y, z), m.")
      .def_readonly("radius", &Capsule::radius, "Its radius, m.")
      .def("__repr__", [](const Capsule& capsule) {
        return py::str("Capsule(start={}, end={}, radius={})")
            .format(numbers(capsule.start), numbers(capsule.end), capsule.radius);
      });
}

SE3 read_box_pose(const OptionalArray& pose, const OptionalArray& center,
                  const OptionalArray& rpy) {
  if (!pose.is_none()) {
    if (!center.is_none() || !rpy.is_none()) {
      throw InvalidArgument("pose", "center or rpy as well", "one or the other");
    }
    return read_pose(read(pose, "pose", {4, 4}, false).data, "pose");
  }
  SE3 T;
  if (!center.is_none()) {
    T.translation = read_point<3>(center, "center");
  }
  if (!rpy.is_none()) {
    T.rotation = rotation_from_rpy(read_point<3>(rpy, "rpy"));
  }
  return T;
}

void bind_box(py::module_& m) {
  bind_shape<Box>(m, "Box", R"(A box of any orientation: a table, a wall.

Outside, the distance is that of the nearest point; inside, that of the nearest face.

Parameters
----------
size : (3,), m
    Its lengths along its own x, y and z.
pose : (4, 4), optional
    Of its middle; or
center : (3,), m, optional
    and
rpy : (3,), rad, optional
    Roll, pitch and yaw. Default: at the origin, along the axes.

Raises
------
ValueError
    If a length is not positive, a number not finite, or the pose no rigid transform.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> table = tk.Box(size=(1.2, 0.8, 0.04), center=(1.0, 0.0, 0.7), rpy=(0.0, 0.0, np.pi / 2))
>>> round(table.signed_distance((1.0, 0.0, 1.0)), 12)
0.28
)")
      .def(py::init([](const ArrayLike& size, const OptionalArray& pose,
                       const OptionalArray& center, const OptionalArray& rpy) {
             return checked(
                 Box{read_box_pose(pose, center, rpy), 0.5 * read_point<3>(size, "size")});
           }),
           py::kw_only(), py::arg("size"), py::arg("pose") = py::none(),
           py::arg("center") = py::none(), py::arg("rpy") = py::none())
      .def_property_readonly(
          "size", [](const Box& box) { return frozen(2.0 * box.half_size); },
          "Lengths along its own axes, m.")
      .def_property_readonly(
          "pose",
          [](const Box& box) {
            const py::ssize_t shape[] = {4, 4};
            Array out = make_array(shape, 2);
            write_pose(box.pose, out.mutable_data());
            out.attr("flags").attr("writeable") = false;
            return out;
          },
          "Of its middle, (4, 4).")
      .def("__repr__", [](const Box& box) {
        const Eigen::Vector3d rpy = rpy_from_rotation(box.pose.rotation);
        return py::str("Box(size={}, center={}, rpy={})")
            .format(numbers(Eigen::Vector3d(2.0 * box.half_size)), numbers(box.pose.translation),
                    numbers(rpy));
      });
}

HalfSpace make_half_space(const ArrayLike& normal, const std::optional<double>& offset,
                          const OptionalArray& point) {
  const Eigen::Vector3d direction = read_point<3>(normal, "normal");
  const Eigen::Vector3d unit = direction.stableNormalized();
  if (!(unit.norm() > 0.5)) {
    throw InvalidArgument("normal", "no direction", "three finite numbers, not all zero");
  }
  if (offset && !point.is_none()) {
    throw InvalidArgument("offset", "point as well", "one or the other");
  }
  if (!offset && point.is_none()) {
    throw InvalidArgument("point", "None, and no offset", "one or the other");
  }
  return checked(HalfSpace{unit, offset ? *offset : unit.dot(read_point<3>(point, "point"))});
}

void bind_half_space(py::module_& m) {
  bind_shape<HalfSpace>(m, "HalfSpace", R"(All that is behind a plane: a floor, a wall.

Parameters
----------
normal : (3,)
    Points out of it, to where the robot may be. Any length but zero.
offset : float, m, optional
    How far from the origin the plane is, along the normal; or
point : (3,), m, optional
    A point of the plane.

Raises
------
ValueError
    If the normal is zero, a number not finite, or not one of offset and point is given.

Examples
--------
>>> import thing_kin as tk
>>> floor = tk.HalfSpace(normal=(0, 0, 1), offset=0.0)
>>> floor.signed_distance((0.3, 0.2, 0.5))
0.5
)")
      .def(py::init(&make_half_space), py::arg("normal"), py::kw_only(),
           py::arg("offset") = py::none(), py::arg("point") = py::none())
      .def_property_readonly(
          "normal", [](const HalfSpace& half) { return frozen(half.normal); }, "Of unit length.")
      .def_readonly("offset", &HalfSpace::offset, "Of the plane along the normal, m.")
      .def("__repr__", [](const HalfSpace& half) {
        return py::str("HalfSpace(normal={}, offset={})").format(numbers(half.normal), half.offset);
      });
}

}  // namespace

void bind_obstacle(py::module_& m) {
  bind_disc(m);
  bind_sphere(m);
  bind_capsule(m);
  bind_box(m);
  bind_half_space(m);
}

}  // namespace thing_kin::python
