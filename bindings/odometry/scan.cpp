#include "thing_kin/odometry/scan.hpp"

#include "odometry/scan.hpp"
#include "odometry_bindings.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/spd.hpp"

namespace thing_kin::python {

namespace {

std::string text_of(const Scanner& s) {
  std::string words = "Scanner(angle_min=" + text(s.angle_min);
  words.append(", angle_max=").append(text(s.angle_max));
  words.append(", n=").append(std::to_string(s.n));
  words.append(", range_min=").append(text(s.range_min));
  words.append(", range_max=").append(text(s.range_max));
  words.append(", mount=(").append(text(s.mount.x())).append(", ").append(text(s.mount.y()));
  words.append(", ").append(text(s.mount.z()));
  words.append("), scan_time=").append(text(s.scan_time));
  return words.append(", noise=").append(text(s.noise)).append(")");
}

Scanner make_scanner(double angle_min, double angle_max, int n, double range_min, double range_max,
                     const ArrayLike& mount, double scan_time, double noise) {
  const Scanner scanner{.angle_min = angle_min,
                        .angle_max = angle_max,
                        .n = n,
                        .range_min = range_min,
                        .range_max = range_max,
                        .mount = read_planar(mount, "mount"),
                        .scan_time = scan_time,
                        .noise = noise};
  check_scanner(scanner);
  return scanner;
}

py::tuple points_of(const Scanner& self, const ArrayLike& ranges, const ArrayLike& twist) {
  const std::vector<double> read_in = read_ranges(self, ranges, "ranges");
  PlanarScan scan;
  read_scan(self, read_in, read_planar(twist, "twist"), scan);
  const auto count = static_cast<py::ssize_t>(scan.size());
  Array points({count, py::ssize_t{2}});
  Array normals({count, py::ssize_t{2}});
  py::array_t<int> beams(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    const ScanPoint& point = scan[static_cast<std::size_t>(i)];
    for (py::ssize_t k = 0; k < 2; ++k) {
      points.mutable_at(i, k) = point.p[k];
      normals.mutable_at(i, k) = point.normal[k];
    }
    beams.mutable_at(i) = point.beam;
  }
  return py::make_tuple(points, normals, beams);
}

}  // namespace

std::vector<double> read_ranges(const Scanner& scanner, const ArrayLike& ranges, const char* name) {
  const Batch batch = read(ranges, name, {scanner.n}, false, Finite::kNo);
  return {batch.data, batch.data + scanner.n};
}

Eigen::Vector3d read_planar(py::handle argument, const char* name) {
  const Batch batch = read(argument, name, {3}, false);
  check_magnitude(batch, name);
  return Eigen::Map<const Eigen::Vector3d>(batch.data);
}

Eigen::Matrix3d read_planar_covariance(py::handle argument, const char* name) {
  const Batch batch = read(argument, name, {3, 3}, false);
  check_magnitude(batch, name);
  const Eigen::Matrix3d P = Eigen::Map<const Eigen::Matrix3d>(batch.data);
  check_covariance(P, 3, name);
  return P;
}

void bind_scan(py::module_& m) {
  const Scanner standard;
  py::class_<Scanner>(m, "Scanner",
                      R"(A planar laser scanner: where its beams go, what they can see.

Immutable. Angles in the scanner's frame, from the first beam to the last; they fall for a scanner
that turns clockwise or hangs upside down.

Parameters
----------
angle_min, angle_max : float, rad
    Of the first and the last beam, at most 4 pi in size.
n : int
    How many beams, 1 to 65536, evenly spaced from `angle_min` to `angle_max`.
range_min, range_max : float, m
    What is nearer than `range_min`, or as far as `range_max` or further, is no return.
mount : (3,), m and rad
    Pose (x, y, yaw) of the scanner in the robot's frame.
scan_time : float, s
    From the first beam to the last; 0 for scans that are flat in time or corrected already. A
    robot that moves meanwhile is taken into account.
noise : float, m
    One standard deviation of a range.

Raises
------
ValueError
    If a number is out of its range; the message names it.

Examples
--------
>>> from thing_kin import odometry
>>> scanner = odometry.Scanner(-1.5, 1.5, 4, range_max=30.0)
>>> scanner.angles
array([-1.5, -0.5,  0.5,  1.5])
)")
      .def(py::init(&make_scanner), py::arg("angle_min"), py::arg("angle_max"), py::arg("n"),
           py::kw_only(), py::arg("range_min") = standard.range_min,
           py::arg("range_max") = standard.range_max, py::arg("mount") = py::make_tuple(0, 0, 0),
           py::arg("scan_time") = standard.scan_time, py::arg("noise") = standard.noise)
      .def_static(
          "ust10lx",
          [](const ArrayLike& mount) {
            Scanner scanner{.angle_min = -0.75 * std::numbers::pi,
                            .angle_max = 0.75 * std::numbers::pi,
                            .n = 1081,
                            .range_min = 0.06,
                            .range_max = 10.0,
                            .mount = read_planar(mount, "mount"),
                            .scan_time = 0.75 * 0.025,
                            .noise = 0.01};
            check_scanner(scanner);
            return scanner;
          },
          py::arg("mount") = py::make_tuple(0, 0, 0), R"(The Hokuyo UST-10LX of [M17] 3.3.2.

270 degrees in steps of a quarter, 0.06 to 10 m, 40 turns a second, of which the beams take three
quarters.

Parameters
----------
mount : (3,), m and rad
    Pose (x, y, yaw) of the scanner in the robot's frame.

Returns
-------
Scanner

Examples
--------
>>> from thing_kin import odometry
>>> odometry.Scanner.ust10lx().n
1081
)")
      .def("points", &points_of, py::arg("ranges"), py::kw_only(),
           py::arg("twist") = py::make_tuple(0, 0, 0), R"(The beams that returned, as points.

REP 117: -inf is too near, +inf no return, NaN an error; none of them is a point.

Parameters
----------
ranges : (n,), m
    One for each beam.
twist : (3,), m/s and rad/s
    (vx, vy, omega) of the robot during the scan, in its own axes; undoes the distortion that
    `scan_time` brings.

Returns
-------
points : (k, 2), m
    In the frame that the robot has at the first beam.
normals : (k, 2)
    Unit normals of the surfaces, towards the scanner; zero where there is no surface to tell.
beams : (k,) int
    Which beams they are.

Raises
------
ValueError
    If `ranges` has another length or `twist` is not finite.

Examples
--------
>>> import numpy as np
>>> from thing_kin import odometry
>>> scanner = odometry.Scanner(0.0, np.pi / 2, 3, mount=(1.0, 0.0, 0.0))
>>> points, normals, beams = scanner.points([2.0, np.inf, 1.0])
>>> points.round(3)
array([[3., 0.],
       [1., 1.]])
>>> beams.tolist()
[0, 2]
)")
      .def_property_readonly(
          "angles",
          [](const Scanner& self) {
            Array angles(self.n);
            for (int i = 0; i < self.n; ++i) {
              angles.mutable_at(i) = self.angle(i);
            }
            return angles;
          },
          "(n,), rad: of each beam, in the scanner's frame.")
      .def_readonly("angle_min", &Scanner::angle_min, "Of the first beam, rad.")
      .def_readonly("angle_max", &Scanner::angle_max, "Of the last beam, rad.")
      .def_readonly("n", &Scanner::n, "How many beams.")
      .def_readonly("range_min", &Scanner::range_min, "Shortest return, m.")
      .def_readonly("range_max", &Scanner::range_max, "Where returns end, m.")
      .def_property_readonly(
          "mount", [](const Scanner& self) { return to_array(self.mount); },
          "(3,): pose (x, y, yaw) in the robot's frame, m and rad.")
      .def_readonly("scan_time", &Scanner::scan_time, "From the first beam to the last, s.")
      .def_readonly("noise", &Scanner::noise, "One standard deviation of a range, m.")
      .def("__eq__", [](const Scanner& a, const Scanner& b) { return a == b; })
      .def("__eq__", [](const Scanner&, const py::object&) { return false; })
      .def("__hash__", [](const Scanner& self) { return py::hash(py::str(text_of(self))); })
      .def("__repr__", &text_of)
      .def(py::pickle(
          [](const Scanner& s) {
            return py::make_tuple(s.angle_min, s.angle_max, s.n, s.range_min, s.range_max,
                                  to_array(s.mount), s.scan_time, s.noise);
          },
          [](const py::tuple& state) {
            if (state.size() != 8) {
              throw InvalidArgument("state", std::to_string(state.size()) + " entries", "8");
            }
            return make_scanner(state[0].cast<double>(), state[1].cast<double>(),
                                state[2].cast<int>(), state[3].cast<double>(),
                                state[4].cast<double>(),
                                py::reinterpret_borrow<ArrayLike>(state[5]),
                                state[6].cast<double>(), state[7].cast<double>());
          }));
}

}  // namespace thing_kin::python
