#include "thing_kin/odometry/differential_drive.hpp"

#include "estimation_bindings.hpp"
#include "odometry/dead_reckoning.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

using Map2 = Eigen::Map<const Eigen::Vector2d>;
using Map3 = Eigen::Map<const Eigen::Vector3d>;
using Drive = DifferentialDriveOdometry;

Drive make_drive(const ArrayLike& wheel_radius, double track) {
  const SmallVector radii = read_number_or_vector(wheel_radius, "wheel_radius", 2, Finite::kYes);
  return Drive(radii[0], radii[1], track);
}

DeadReckoning integrate(const Drive& drive, const ArrayLike& t, const ArrayLike& wheels,
                        const char* name, bool differences, const PlanarEstimate& start,
                        const WheelNoise& noise) {
  const Batch read_wheels = read(wheels, name, {2});
  check_magnitude(read_wheels, name);
  if (read_wheels.single || read_wheels.count == 0) {
    throw InvalidArgument(name, read_wheels.single ? "shape (2,)" : "shape (0, 2)",
                          "(N, 2) with a row for each stamp");
  }
  const Batch stamps = read_stamps(t, read_wheels.count);
  const Eigen::Array2d radii(drive.left_radius(), drive.right_radius());
  std::vector<WheelRow> rows;
  for (py::ssize_t i = 1; i < read_wheels.count; ++i) {
    const double dt = stamps.data[i] - stamps.data[i - 1];
    Eigen::Vector2d turned = Map2(read_wheels.item(i));
    if (differences) {
      turned -= Map2(read_wheels.item(i - 1));
    } else {
      turned *= dt;
    }
    rows.push_back({drive.twist(turned), dt, (radii * turned.array()).abs().mean()});
  }
  return reckon(start, rows, noise);
}

std::string text_of_drive(const Drive& drive) {
  std::string words = "DifferentialDriveOdometry(wheel_radius=(" + text(drive.left_radius());
  words.append(", ").append(text(drive.right_radius())).append("), track=");
  return words.append(text(drive.track())).append(")");
}

void bind_drive_maps(py::class_<Drive>& drive) {
  drive.def(
      "twist",
      [](const Drive& self, const ArrayLike& wheel_speeds) {
        return map(read_moderate(wheel_speeds, "wheel_speeds", 2), {3},
                   [&](const double* in, double* out) {
                     Eigen::Map<Eigen::Vector3d>{out} = self.twist(Map2(in));
                   });
      },
      py::arg("wheel_speeds"), R"(Twist of the middle of the axle.

Parameters
----------
wheel_speeds : (2,) or (N, 2), rad/s
    (left, right).

Returns
-------
(3,) or (N, 3), m/s and rad/s
    (vx, 0, omega) in the axes of the body.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.DifferentialDriveOdometry(0.1, track=0.4).twist([1.0, 3.0])
array([0.2, 0. , 0.5])
)");
  drive.def(
      "wheel_speeds",
      [](const Drive& self, const ArrayLike& twist) {
        const Batch batch = read_moderate(twist, "twist", 3);
        for (py::ssize_t i = 0; i < batch.count; ++i) {
          if (batch.item(i)[1] != 0.0) {
            throw InvalidArgument("twist", "vy = " + text(batch.item(i)[1]),
                                  "vy = 0: two wheels cannot drive sideways");
          }
        }
        return map(batch, {2}, [&](const double* in, double* out) {
          Eigen::Map<Eigen::Vector2d>{out} = self.wheel_speeds(Map3(in));
        });
      },
      py::arg("twist"), R"(Wheel speeds of a twist.

Parameters
----------
twist : (3,) or (N, 3), m/s and rad/s
    (vx, 0, omega) in the axes of the body.

Returns
-------
(2,) or (N, 2), rad/s
    (left, right).

Raises
------
ValueError
    If vy is not zero.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.DifferentialDriveOdometry(0.1, track=0.4).wheel_speeds([0.2, 0.0, 0.5])
array([1., 3.])
)");
}

}  // namespace

void bind_differential_drive(py::module_& m) {
  py::class_<Drive> drive(m, "DifferentialDriveOdometry",
                          R"(Odometry of two driven wheels on one axle; not in the theses.

Parameters
----------
wheel_radius : float or (2,), m
    Of both wheels, or (left, right).
track : float, m
    Between the wheels' contact points.

Raises
------
ValueError
    If a length is not positive and finite.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> drive = est.DifferentialDriveOdometry((0.1, 0.101), track=0.4)
>>> path = drive.integrate([0.0, 1.0, 2.0], np.full((3, 2), 2.0))
>>> path.poses[-1].round(4)  # the right wheel is larger
array([0.402, 0.002, 0.01 ])
)");
  drive.def(py::init(&make_drive), py::arg("wheel_radius"), py::arg("track"));
  drive.def_property_readonly(
      "wheel_radius",
      [](const Drive& self) { return py::make_tuple(self.left_radius(), self.right_radius()); },
      "Radii (left, right), m.");
  drive.def_property_readonly("track", &Drive::track, "Between the wheels, m.");
  drive.def("__eq__", [](const Drive& self, const py::object& other) {
    return py::isinstance<Drive>(other) && self == other.cast<Drive>();
  });
  drive.def("__repr__", &text_of_drive);
  bind_drive_maps(drive);
  drive.def(
      "integrate",
      [](const Drive& self, const ArrayLike& t, const ArrayLike& wheel_speeds,
         const ArrayLike& pose, const OptionalArray& covariance,
         const OptionalArray& twist_covariance, const OptionalArray& slip_variance) {
        return integrate(self, t, wheel_speeds, "wheel_speeds", false, read_start(pose, covariance),
                         {twist_covariance, slip_variance});
      },
      py::arg("t"), py::arg("wheel_speeds"), py::arg("pose") = py::make_tuple(0.0, 0.0, 0.0),
      py::arg("covariance") = py::none(), py::kw_only(), py::arg("twist_covariance") = py::none(),
      py::arg("slip_variance") = py::none(), R"(Poses along a record of wheel speeds.

Parameters
----------
t : (N,), s
    Not decreasing.
wheel_speeds : (N, 2), rad/s
    (left, right); row i is the mean since the stamp before.
pose, covariance, twist_covariance, slip_variance
    As for MecanumOdometry.integrate.

Returns
-------
DeadReckoning
    N poses.

Raises
------
ValueError
    If a shape does not fit, stamps decrease, a number is not finite or a covariance is none.

Examples
--------
>>> from thing_kin import estimation as est
>>> drive = est.DifferentialDriveOdometry(0.1, track=0.4)
>>> drive.integrate([0.0, 1.0], [[0.0, 0.0], [1.0, 1.0]]).poses[-1]
array([0.1, 0. , 0. ])
)");
  drive.def(
      "integrate_angles",
      [](const Drive& self, const ArrayLike& t, const ArrayLike& wheel_angles,
         const ArrayLike& pose, const OptionalArray& covariance,
         const OptionalArray& twist_covariance, const OptionalArray& slip_variance) {
        return integrate(self, t, wheel_angles, "wheel_angles", true, read_start(pose, covariance),
                         {twist_covariance, slip_variance});
      },
      py::arg("t"), py::arg("wheel_angles"), py::arg("pose") = py::make_tuple(0.0, 0.0, 0.0),
      py::arg("covariance") = py::none(), py::kw_only(), py::arg("twist_covariance") = py::none(),
      py::arg("slip_variance") = py::none(), R"(Poses along a record of wheel angles.

Parameters
----------
t : (N,), s
    Not decreasing.
wheel_angles : (N, 2), rad
    (left, right), whole turns included; of encoders: see angles_from_ticks.
pose, covariance, twist_covariance, slip_variance
    As for MecanumOdometry.integrate.

Returns
-------
DeadReckoning
    N poses.

Raises
------
ValueError
    As integrate.

Examples
--------
>>> from thing_kin import estimation as est
>>> drive = est.DifferentialDriveOdometry(0.1, track=0.4)
>>> drive.integrate_angles([0.0, 1.0], [[0.0, 0.0], [1.0, 1.0]]).poses[-1]
array([0.1, 0. , 0. ])
)");
}

}  // namespace thing_kin::python
