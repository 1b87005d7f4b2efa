#include "thing_kin/odometry/mecanum.hpp"

#include <pybind11/stl.h>

#include "estimation_bindings.hpp"
#include "odometry/dead_reckoning.hpp"
#include "odometry/mecanum.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

using Map3 = Eigen::Map<const Eigen::Vector3d>;
using Map4 = Eigen::Map<const Eigen::Vector4d>;

// `differences`: rows are angles, whose steps are what turned; else speeds, held since the stamp
// before.
DeadReckoning integrate(const MecanumOdometry& odometry, const ArrayLike& t, const Batch& wheels,
                        bool differences, const PlanarEstimate& start, const WheelNoise& noise) {
  const Batch stamps = read_stamps(t, wheels.count);
  std::vector<WheelRow> rows;
  for (py::ssize_t i = 1; i < wheels.count; ++i) {
    const double dt = stamps.data[i] - stamps.data[i - 1];
    const Eigen::Vector4d turned =
        differences ? Eigen::Vector4d(Map4(wheels.item(i)) - Map4(wheels.item(i - 1)))
                    : Eigen::Vector4d(Map4(wheels.item(i)) * dt);
    const double travel = odometry.wheel_radius() * turned.cwiseAbs().mean();
    rows.push_back({odometry.twist(turned), dt, travel});
  }
  return reckon(start, rows, noise);
}

Batch read_record(const ArrayLike& wheels, const char* name) {
  Batch batch = read(wheels, name, {4});
  check_magnitude(batch, name);
  if (batch.single || batch.count == 0) {
    throw InvalidArgument(name, batch.single ? "shape (4,)" : "shape (0, 4)",
                          "(N, 4) with a row for each stamp");
  }
  return batch;
}

std::string text_of(const MecanumOdometry& odometry) {
  std::string words = "MecanumOdometry(wheel_radius=" + text(odometry.wheel_radius());
  words.append(", k=").append(text(odometry.k())).append(", order=(");
  for (const std::string& name : odometry.order().names()) {
    words.append(words.back() == '(' ? "" : ", ").append(quoted(name));
  }
  return words.append("))");
}

void bind_maps(py::class_<MecanumOdometry>& odometry) {
  odometry.def(
      "twist",
      [](const MecanumOdometry& self, const ArrayLike& wheel_speeds) {
        return map(read_moderate(wheel_speeds, "wheel_speeds", 4), {3},
                   [&](const double* in, double* out) {
                     Eigen::Map<Eigen::Vector3d>{out} = self.twist(Map4(in));
                   });
      },
      py::arg("wheel_speeds"), R"(Twist of the body, [M17] (3.20).

Where the wheels contradict each other it is the one that fits them best (least squares).

Parameters
----------
wheel_speeds : (4,) or (N, 4), rad/s
    In the order of the wheels.

Returns
-------
(3,) or (N, 3), m/s and rad/s
    (vx, vy, omega) in the axes of the body.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.MecanumOdometry(0.1, k=0.5).twist([1.0, 1.0, 1.0, 1.0])
array([0.1, 0. , 0. ])
)");
  odometry.def(
      "wheel_speeds",
      [](const MecanumOdometry& self, const ArrayLike& twist) {
        return map(read_moderate(twist, "twist", 3), {4}, [&](const double* in, double* out) {
          Eigen::Map<Eigen::Vector4d>{out} = self.wheel_speeds(Map3(in));
        });
      },
      py::arg("twist"), R"(Wheel speeds that roll without slipping, the inverse of [M17] (3.20).

Parameters
----------
twist : (3,) or (N, 3), m/s and rad/s
    (vx, vy, omega) in the axes of the body.

Returns
-------
(4,) or (N, 4), rad/s
    In the order of the wheels.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.MecanumOdometry(0.1, k=0.5).wheel_speeds([0.0, 0.1, 0.0])
array([-1.,  1., -1.,  1.])
)");
  odometry.def(
      "slip",
      [](const MecanumOdometry& self, const ArrayLike& wheel_speeds) {
        return map_scalar(read_moderate(wheel_speeds, "wheel_speeds", 4),
                          [&](const double* in) { return self.slip(Map4(in)); });
      },
      py::arg("wheel_speeds"), R"(What four wheels say beyond the three numbers of a twist.

R/4 (fl - rl - rr + fr): zero while all wheels roll. If not, each rim slips at least so fast. Of
angles instead of speeds it is a way in m.

Parameters
----------
wheel_speeds : (4,) or (N, 4), rad/s

Returns
-------
float or (N,), m/s
    Positive where the front wheels turn faster.

Examples
--------
>>> from thing_kin import estimation as est
>>> wheels = est.MecanumOdometry(0.1, k=0.5)
>>> wheels.slip(wheels.wheel_speeds([0.3, -0.2, 1.0])).__abs__() < 1e-15
True
>>> wheels.slip([1.0, 0.0, 0.0, 1.0])
0.05
)");
}

}  // namespace

WheelOrder read_order(const py::object& order) {
  std::array<std::string, 4> names;
  py::ssize_t count = 0;
  bool fits =
      py::isinstance<py::sequence>(order) && !py::isinstance<py::str>(order) && py::len(order) == 4;
  for (; fits && count < 4; ++count) {
    const py::object name = order[py::int_(count)];
    fits = py::isinstance<py::str>(name);
    names[static_cast<std::size_t>(count)] = fits ? name.cast<std::string>() : "";
  }
  if (!fits) {
    throw InvalidArgument("order", py::repr(order), "('fl', 'rl', 'rr', 'fr') in any order");
  }
  return WheelOrder(names);
}

py::tuple default_order() { return py::cast(WheelOrder().names()).cast<py::tuple>(); }

void bind_mecanum(py::module_& m) {
  py::class_<MecanumOdometry> odometry(m, "MecanumOdometry",
                                       R"(Odometry of four mecanum wheels, [M17] (3.20).

Parameters
----------
wheel_radius : float, m
k : float, m
    Half the wheel base plus half the track.
order : sequence of str
    Which wheel is which in every array: 'fl' front left, 'rl' rear left, 'rr' rear right,
    'fr' front right. Default: the order of (3.20).

Raises
------
ValueError
    If a length is not positive and finite, or the order is none.

Examples
--------
>>> from thing_kin import estimation as est
>>> wheels = est.MecanumOdometry(0.07, k=0.369, order=("fl", "fr", "rl", "rr"))
>>> wheels.wheel_speeds([0.0, 0.0, 1.0]).round(2)  # turning left, the right wheels go forwards
array([-5.27,  5.27, -5.27,  5.27])
)");
  odometry.def(py::init([](double wheel_radius, double k, const py::object& order) {
                 return MecanumOdometry(wheel_radius, k, read_order(order));
               }),
               py::arg("wheel_radius"), py::arg("k"), py::arg("order") = default_order());
  odometry.def_property_readonly("wheel_radius", &MecanumOdometry::wheel_radius, "Radius, m.");
  odometry.def_property_readonly("k", &MecanumOdometry::k,
                                 "Half the wheel base plus half the track, m.");
  odometry.def_property_readonly(
      "order",
      [](const MecanumOdometry& self) { return py::tuple(py::cast(self.order().names())); },
      "Names of the wheels in the order of every array.");
  odometry.def("__eq__", [](const MecanumOdometry& self, const py::object& other) {
    return py::isinstance<MecanumOdometry>(other) && self == other.cast<MecanumOdometry>();
  });
  odometry.def("__repr__", &text_of);
  bind_maps(odometry);
  odometry.def(
      "integrate",
      [](const MecanumOdometry& self, const ArrayLike& t, const ArrayLike& wheel_speeds,
         const ArrayLike& pose, const OptionalArray& covariance,
         const OptionalArray& twist_covariance, const OptionalArray& slip_variance) {
        return integrate(self, t, read_record(wheel_speeds, "wheel_speeds"), false,
                         read_start(pose, covariance), {twist_covariance, slip_variance});
      },
      py::arg("t"), py::arg("wheel_speeds"), py::arg("pose") = py::make_tuple(0.0, 0.0, 0.0),
      py::arg("covariance") = py::none(), py::kw_only(), py::arg("twist_covariance") = py::none(),
      py::arg("slip_variance") = py::none(), R"(Poses along a record of wheel speeds.

Row i is the mean speed since the stamp before; that of the first row is not used.

Parameters
----------
t : (N,), s
    Not decreasing.
wheel_speeds : (N, 4), rad/s
pose : (3,), m and rad
    At t[0].
covariance : (3, 3), optional
    Of that pose, in world axes; default: zero.
twist_covariance : (3, 3), optional
    Of each row's twist, in the axes of the body; it enters the pose as R dt^2. Default:
    diag(0.001, 0.001, 0.03), [M17] (3.22).
slip_variance : (3,), m^2/m and rad^2/m, optional
    Instead of it: variances of x, y and theta in the axes of the body for each metre that the
    rims travel, as identify_mecanum finds them.

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
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> wheels = est.MecanumOdometry(0.07, k=0.369)
>>> t = np.linspace(0.0, 2.0, 101)
>>> path = wheels.integrate(t, np.tile(wheels.wheel_speeds([0.2, 0.1, 0.0]), (101, 1)))
>>> path.poses[-1, :2].round(3)
array([0.4, 0.2])
)");
  odometry.def(
      "integrate_angles",
      [](const MecanumOdometry& self, const ArrayLike& t, const ArrayLike& wheel_angles,
         const ArrayLike& pose, const OptionalArray& covariance,
         const OptionalArray& twist_covariance, const OptionalArray& slip_variance) {
        return integrate(self, t, read_record(wheel_angles, "wheel_angles"), true,
                         read_start(pose, covariance), {twist_covariance, slip_variance});
      },
      py::arg("t"), py::arg("wheel_angles"), py::arg("pose") = py::make_tuple(0.0, 0.0, 0.0),
      py::arg("covariance") = py::none(), py::kw_only(), py::arg("twist_covariance") = py::none(),
      py::arg("slip_variance") = py::none(), R"(Poses along a record of wheel angles.

Of encoders: see angles_from_ticks.

Parameters
----------
t : (N,), s
    Not decreasing.
wheel_angles : (N, 4), rad
    Whole turns included.
pose, covariance, twist_covariance, slip_variance
    As for integrate.

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
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> wheels = est.MecanumOdometry(0.1, k=0.5)
>>> path = wheels.integrate_angles([0.0, 1.0], [[0, 0, 0, 0], [2.0, 2.0, 2.0, 2.0]])
>>> path.poses[-1]
array([0.2, 0. , 0. ])
)");
}

}  // namespace thing_kin::python
