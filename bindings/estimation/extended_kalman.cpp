#include "thing_kin/estimation/extended_kalman.hpp"

#include "estimation/nonlinear_filter.hpp"
#include "estimation_bindings.hpp"
#include "quick_method.hpp"

namespace thing_kin::python {

void bind_extended_kalman(py::module_& m) {
  using Filter = ExtendedKalmanFilter;
  py::class_<Filter, GaussianFilter> filter(
      m, "ExtendedKalmanFilter",
      R"(The extended Kalman filter, [M17] (3.24), (3.25), in Joseph's form.

Models are functions of one's own, with their Jacobians or without (then they are differentiated by
central differences, 2 n calls each), or built in (thing_kin.estimation.models): these run in the core.
check_jacobian compares a Jacobian of one's own with differences.

Parameters
----------
x : (n,), n up to 16
    The state.
P : (n, n)
    Its covariance, positive semidefinite.
angles : sequence of int
    Which entries of the state are angles: they are kept in (-pi, pi], and differences are the short
    way round. A planar pose (x, y, theta) has angles=(2,).

Raises
------
ValueError
    If an argument has another shape, is not finite or is no covariance; its name comes first.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> filter = est.ExtendedKalmanFilter([1.0, 2.0, 0.0], 0.1 * np.eye(3), angles=(2,))
>>> filter.update([2.2, 0.1], lambda x: [np.hypot(*x[:2]), x[2]], 0.01 * np.eye(2), angles=(1,))
True
>>> filter.x.round(3)
array([0.985, 1.971, 0.091])
)");
  filter.def(py::init([](const ArrayLike& x, const ArrayLike& P, const Indices& angles) {
               const InitialState state(x, P, angles);
               return Filter(state.x, state.P, state.angles);
             }),
             py::arg("x"), py::arg("P"), py::kw_only(), py::arg("angles") = py::tuple());
  bind_covariance<Filter>(filter);
  QuickMethod<&predict_nonlinear<Filter>>::define(
      filter, "predict", py::arg("f"), py::arg("Q") = py::none(), py::arg("jacobian") = py::none(),
      py::kw_only(), py::arg("dt") = py::none(),
      R"(One step in time: x = f(x), P = F P F^T + Q, [M17] (3.24).

Parameters
----------
f : callable, MotionModel or (n, n)
    f(x) -> (n,), the state moved; a built-in model, which runs in the core; or a matrix.
Q : (n, n), optional
    Process noise, positive semidefinite. Default, for a built-in model: its own over dt.
jacobian : callable, optional
    jacobian(x) -> (n, n) of a function. Default: differences.
dt : float, s, optional
    How far a built-in model moves, which needs it.

Returns
-------
bool
    Whether it was made; if not, the state is as it was, and status says why.

Raises
------
ValueError
    If an argument or what a function returns has another shape, is not finite or is no covariance.
    What a function raises is raised. The state is as it was.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> filter = est.ExtendedKalmanFilter([0.0, 1.0], np.eye(2))
>>> filter.predict(lambda x: [x[0] + np.sin(x[1]), x[1]], 0.01 * np.eye(2))
True
>>> filter.predict(est.models.constant_velocity(1), dt=0.5)
True
>>> filter.x.round(3)
array([1.341, 1.   ])
)");
  QuickMethod<&update_nonlinear<Filter>>::define(
      filter, "update", py::arg("z"), py::arg("h"), py::arg("R"), py::arg("jacobian") = py::none(),
      py::arg("gate") = py::none(), py::kw_only(), py::arg("angles") = py::tuple(),
      R"(A measurement z = h(x) + noise, [M17] (3.25).

Parameters
----------
z : (m,), m up to 16
h : callable, MeasurementModel or (m, n)
    h(x) -> (m,), what is expected; a built-in model, which knows its angles; or a matrix.
R : (m, m)
    Measurement noise, positive semidefinite.
jacobian : callable, optional
    jacobian(x) -> (m, n) of a function. Default: differences.
gate : float, optional
    A probability: the measurement is rejected if its NIS is beyond what a right one stays below with
    that probability.
angles : sequence of int
    Which entries of z are angles.

Returns
-------
bool
    Whether it was made; if not, the state is as it was, and status says why.

Raises
------
ValueError
    If an argument or what a function returns has another shape, is not finite or is no covariance,
    or gate is no probability. What a function raises is raised. The state is as it was.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> filter = est.ExtendedKalmanFilter([0.0, 0.0, 0.0], np.eye(3), angles=(2,))
>>> filter.update([3.0, -0.1], est.models.range_bearing((3.0, 0.0)), 0.01 * np.eye(2))
True
>>> filter.status, round(filter.nis, 3)
('ok', 0.009)
)");
  filter.def(
      "run",
      [](Filter& self, const ArrayLike& record, const MotionLike& f, const MeasurementLike& h,
         const ArrayLike& R, const OptionalArray& Q, const OptionalFunction& f_jacobian,
         const OptionalFunction& h_jacobian, const OptionalArray& dt, const OptionalNumber& gate,
         const Indices& angles, bool smooth) {
        return run_nonlinear(self, record, {f, f_jacobian, h, h_jacobian, Q, dt}, R, gate, angles,
                             smooth);
      },
      py::arg("record"), py::kw_only(), py::arg("f"), py::arg("h"), py::arg("R"),
      py::arg("Q") = py::none(), py::arg("f_jacobian") = py::none(),
      py::arg("h_jacobian") = py::none(), py::arg("dt") = py::none(), py::arg("gate") = py::none(),
      py::arg("angles") = py::tuple(), py::arg("smooth") = false,
      R"(Predict, then update, for each row of a record; with built-in models, in the core.

The filter is then where the record ends. Smoothing is that of Rauch, Tung & Striebel.

Parameters
----------
record : (N, m), or (N,) for m = 1
    A row of NaN is no update.
f : callable, MotionModel, (n, n) or (N, n, n)
h : callable, MeasurementModel, (m, n) or (N, m, n)
R : (m, m) or (N, m, m)
Q : (n, n) or (N, n, n), optional
    Default, for a built-in model: its own over dt.
f_jacobian, h_jacobian : callable, optional
    As jacobian in predict and update.
dt : float or (N,), s, optional
    How far a built-in model moves before each row.
gate : float, optional
    As in update.
angles : sequence of int
    As in update.
smooth : bool
    Also estimate each state from the whole record.

Returns
-------
FilterRun

Raises
------
ValueError
    As in predict and update, and if a row is NaN in part; the filter is as it was.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> filter = est.ExtendedKalmanFilter([0.0, 0.0], np.eye(2))
>>> run = filter.run([1.0, np.nan, 4.0], f=est.models.constant_velocity(1), dt=[1.0, 1.0, 2.0],
...                  h=[[1.0, 0.0]], R=[[0.01]], smooth=True)
>>> run.x_smooth[:, 0].round(2)
array([1. , 1.9, 4. ])
)");
}

}  // namespace thing_kin::python
