#include "thing_kin/estimation/motion_models.hpp"

#include <array>
#include <memory>
#include <string>

#include <pybind11/stl.h>

#include "estimation_bindings.hpp"
#include "filter_arguments.hpp"
#include "map.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

using MotionHolder = std::shared_ptr<MotionModel>;

MotionHolder motion_holder(const MotionModelPtr& model) {
  return std::const_pointer_cast<MotionModel>(model);
}

double check_seconds(double dt) {
  if (!(std::isfinite(dt) && dt >= 0.0)) {
    throw InvalidArgument("dt", text(dt), "a finite number of seconds from 0");
  }
  return dt;
}

// A density for each of `size` axes, or one for all.
Eigen::VectorXd densities(const ArrayLike& noise, py::ssize_t size) {
  return read_number_or_vector(noise, "noise", size, Finite::kYes);
}

Array moved_by(const MotionModel& model, const ArrayLike& x, double dt) {
  const int n = model.size();
  const Batch states = read_vectors(x, "x", n);
  check_magnitude(states, "x");
  check_seconds(dt);
  return map(states, {n}, [&](const double* in, double* out) {
    model.step(in, dt, out);
    model.angles().wrap(out);
  });
}

Array model_matrices(const MotionModel& model, const ArrayLike& x, double dt, bool noise) {
  const int n = model.size();
  const Batch states = read_vectors(x, "x", n);
  check_magnitude(states, "x");
  check_seconds(dt);
  return map(states, {n, n}, [&](const double* in, double* out) {
    noise ? model.noise(in, dt, out) : model.jacobian(in, dt, out);
  });
}

void bind_motion_model(py::module_& m) {
  py::class_<MotionModel, MotionHolder>(m, "MotionModel", py::is_final(),
                                        R"(How a state moves, with its exact Jacobian and its noise.

Made by the functions of thing_kin.estimation.models. It is passed to a filter in place of a function,
and then runs in the core; or called, model(x, dt).

Examples
--------
>>> from thing_kin import estimation as est
>>> model = est.models.constant_velocity(2)
>>> model
constant_velocity: x, y, vx, vy
>>> model([0.0, 0.0, 1.0, 0.5], 0.1)
array([0.1 , 0.05, 1.  , 0.5 ])
)")
      .def_property_readonly("name", &MotionModel::name,
                             "What the function that made it is called.")
      .def_property_readonly("n", &MotionModel::size, "How many variables the state has.")
      .def_property_readonly(
          "variables",
          [](const MotionModel& model) { return py::tuple(py::cast(model.variables())); },
          "Their names, in order.")
      .def_property_readonly(
          "angles",
          [](const MotionModel& model) { return py::tuple(py::cast(model.angles().indices())); },
          "Which of them are angles: what the filter is made with.")
      .def("__call__", &moved_by, py::arg("x"), py::arg("dt"), R"(The state dt seconds later.

Parameters
----------
x : (n,) or (N, n)
dt : float, s

Returns
-------
(n,) or (N, n)
    With angles in (-pi, pi].
)")
      .def(
          "jacobian",
          [](const MotionModel& model, const ArrayLike& x, double dt) {
            return model_matrices(model, x, dt, false);
          },
          py::arg("x"), py::arg("dt"), R"(The derivative of the moved state with respect to x.

Parameters
----------
x : (n,) or (N, n)
dt : float, s

Returns
-------
(n, n) or (N, n, n)

Raises
------
ValueError
    If an argument has another shape or is not finite, or dt is negative.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.models.constant_velocity(1).jacobian([0.0, 1.0], 0.1)
array([[1. , 0.1],
       [0. , 1. ]])
)")
      .def(
          "process_noise",
          [](const MotionModel& model, const ArrayLike& x, double dt) {
            return model_matrices(model, x, dt, true);
          },
          py::arg("x"), py::arg("dt"), R"(The covariance that the model's noise adds in dt seconds.

Parameters
----------
x : (n,) or (N, n)
dt : float, s

Returns
-------
(n, n) or (N, n, n)

Raises
------
ValueError
    If an argument has another shape or is not finite, or dt is negative.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.models.constant_velocity(1, noise=3.0).process_noise([0.0, 0.0], 1.0)
array([[1. , 1.5],
       [1.5, 3. ]])
)")
      .def("__repr__", [](const MotionModel& model) {
        std::string text = model.name();
        const char* before = ": ";
        for (const std::string& variable : model.variables()) {
          text.append(before).append(variable);
          before = ", ";
        }
        return text;
      });
}

}  // namespace

void bind_motion_models(py::module_& models, py::module_& m) {
  bind_motion_model(m);
  models.def(
      "constant_velocity",
      [](int dimension, const ArrayLike& noise) {
        return motion_holder(constant_velocity(dimension, densities(noise, 1)[0]));
      },
      py::arg("dimension") = 2, py::kw_only(), py::arg("noise") = 1.0,
      R"(Positions, then velocities, of one to three axes: x + v dt.

Parameters
----------
dimension : int
noise : float, m^2/s^3
    Spectral density of a white acceleration: the process noise where a filter is given no Q.

Returns
-------
MotionModel

Raises
------
ValueError
    If an argument is out of range.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.models.constant_velocity(2).variables
('x', 'y', 'vx', 'vy')
)");
  models.def(
      "constant_acceleration",
      [](int dimension, const ArrayLike& noise) {
        return motion_holder(constant_acceleration(dimension, densities(noise, 1)[0]));
      },
      py::arg("dimension") = 2, py::kw_only(), py::arg("noise") = 1.0,
      R"(Positions, velocities, accelerations of one to three axes: x + v dt + a dt^2/2.

Parameters
----------
dimension : int
noise : float, m^2/s^5
    Spectral density of a white jerk: the process noise where a filter is given no Q.

Returns
-------
MotionModel

Raises
------
ValueError
    If an argument is out of range.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.models.constant_acceleration(1)([0.0, 0.0, 2.0], 1.0)
array([1., 2., 2.])
)");
  models.def(
      "constant_twist",
      [](const ArrayLike& noise) {
        return motion_holder(constant_twist(Eigen::Vector3d(densities(noise, 3))));
      },
      py::kw_only(), py::arg("noise") = 1.0,
      R"(A planar pose and its body twist, held: the pose moves by exp(twist dt), exact on SE(2).

State (x, y, theta, vx, vy, omega), theta an angle; [M17] (3.20), integrated without error.

Parameters
----------
noise : float or (3,)
    Spectral densities of white accelerations along and about the body's axes, (m/s^2)^2 s twice and
    (rad/s^2)^2 s: the process noise where a filter is given no Q.

Returns
-------
MotionModel

Raises
------
ValueError
    If noise is negative or not finite.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> quarter = est.models.constant_twist()([0, 0, 0, np.pi / 2, 0, np.pi / 2], 1.0)
>>> quarter[:3].round(6)
array([1.      , 1.      , 1.570796])
)");
  models.def(
      "omnidirectional",
      [](const std::optional<ArrayLike>& noise) {
        return motion_holder(omnidirectional(
            noise ? Eigen::Matrix<double, 8, 1>(densities(*noise, 8)) : omnidirectional_noise()));
      },
      py::kw_only(), py::arg("noise") = py::none(),
      R"(The planar mode of robot_localization: pose, body velocities and accelerations.

State (x, y, theta, vx, vy, omega, ax, ay), theta an angle. The position moves along the heading at
the beginning of the step, as there; constant_twist turns on the way.

Parameters
----------
noise : float or (8,), optional
    Variance that each variable gains per second. Default: that of robot_localization.

Returns
-------
MotionModel

Raises
------
ValueError
    If noise is negative or not finite.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.models.omnidirectional().angles
(2,)
)");
}

}  // namespace thing_kin::python
