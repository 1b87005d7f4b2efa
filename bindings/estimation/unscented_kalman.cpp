#include "thing_kin/estimation/unscented_kalman.hpp"

#include <algorithm>
#include <array>

#include "estimation/nonlinear_filter.hpp"
#include "estimation_bindings.hpp"
#include "quick_method.hpp"

namespace thing_kin::python {

namespace {

UnscentedOptions read_options(const OptionalNumber& alpha, const OptionalNumber& beta,
                              const OptionalNumber& kappa, bool square_root, Eigen::Index n) {
  UnscentedOptions options;
  options.alpha = alpha.is_none() ? options.alpha : read_number(alpha, "alpha");
  options.beta = beta.is_none() ? options.beta : read_number(beta, "beta");
  options.kappa = kappa.is_none() ? 3.0 - static_cast<double>(n) : read_number(kappa, "kappa");
  options.square_root = square_root;
  return options;
}

Array points_of(UnscentedKalmanFilter& self) {
  SigmaPoints X;
  self.sigma_points(X);
  const std::array<py::ssize_t, 2> shape{X.cols(), X.rows()};
  Array points = make_array(shape.data(), 2);
  std::copy_n(X.data(), X.size(), points.mutable_data());
  return points;
}

bool predict_unscented(UnscentedKalmanFilter& self, const MotionLike& f, const OptionalArray& Q,
                       const OptionalNumber& dt) {
  return predict_nonlinear(self, f, Q, py::reinterpret_borrow<OptionalFunction>(py::none()), dt);
}

bool update_unscented(UnscentedKalmanFilter& self, const ArrayLike& z, const MeasurementLike& h,
                      const ArrayLike& R, const OptionalNumber& gate, const Indices& angles) {
  const auto jacobian = py::reinterpret_borrow<OptionalFunction>(py::none());
  return update_nonlinear(self, z, h, R, jacobian, gate, angles);
}

}  // namespace

void bind_unscented_kalman(py::module_& m) {
  using Filter = UnscentedKalmanFilter;
  py::class_<Filter, GaussianFilter> filter(
      m, "UnscentedKalmanFilter",
      R"(The unscented Kalman filter with scaled sigma points, [X21] (2.6) to (2.9).

Sigma points are redrawn after Q is added, from the lower Cholesky factor of P. The sums of (2.6) and
(2.7) are taken as differences from the central point, in which the weights do not cancel; what may be
taken away is one down-date of weight beta - alpha^2, and where that costs positivity the status says
so and the state is as it was. (2.9) leaves the weights open: they are those of [40] there.

Parameters
----------
x : (n,), n up to 16
    The state.
P : (n, n)
    Its covariance, positive semidefinite.
alpha : float, optional
    Spread of the points, above 0. Default: 0.1.
beta : float, optional
    Default: 2, best for Gaussians.
kappa : float, optional
    Above -n. Default: 3 - n.
angles : sequence of int
    Which entries of the state are angles: they are kept in (-pi, pi], and means and differences are
    taken the short way round from the central point. A planar pose (x, y, theta) has angles=(2,).
square_root : bool
    Keep the factor of P rather than P: covariances are never added up.

Raises
------
ValueError
    If an argument has another shape, is not finite, out of range or no covariance; its name comes
    first.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> filter = est.UnscentedKalmanFilter([1.0, 2.0, 0.0], 0.1 * np.eye(3), angles=(2,))
>>> filter.update([2.2, 0.1], lambda x: [np.hypot(*x[:2]), x[2]], 0.01 * np.eye(2), angles=(1,))
True
>>> filter.x.round(3)
array([0.976, 1.953, 0.091])
)");
  filter.def(py::init([](const ArrayLike& x, const ArrayLike& P, const OptionalNumber& alpha,
                         const OptionalNumber& beta, const OptionalNumber& kappa,
                         const Indices& angles, bool square_root) {
               const InitialState state(x, P, angles);
               return Filter(state.x, state.P,
                             read_options(alpha, beta, kappa, square_root, state.x.size()),
                             state.angles);
             }),
             py::arg("x"), py::arg("P"), py::arg("alpha") = py::none(),
             py::arg("beta") = py::none(), py::arg("kappa") = py::none(), py::kw_only(),
             py::arg("angles") = py::tuple(), py::arg("square_root") = false);
  filter
      .def_property_readonly(
          "alpha", [](const Filter& self) { return self.options().alpha; }, "Spread of the points.")
      .def_property_readonly(
          "beta", [](const Filter& self) { return self.options().beta; }, "2 for Gaussians.")
      .def_property_readonly(
          "kappa", [](const Filter& self) { return self.options().kappa; }, "3 - n by default.")
      .def_property_readonly(
          "square_root", [](const Filter& self) { return self.options().square_root; },
          "Whether the factor of P is kept.")
      .def("sigma_points", &points_of, R"(The points that the next step is taken with, [X21] (2.9).

Returns
-------
(2 n + 1, n)
    The state; then, for each column of the lower Cholesky factor of (n + lambda) P, the state plus
    it; then minus it.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.UnscentedKalmanFilter([1.0], [[4.0]], alpha=1.0, kappa=0.0).sigma_points().ravel()
array([ 1.,  3., -1.])
)");
  bind_covariance<Filter>(filter);
  QuickMethod<&predict_unscented>::define(filter, "predict", py::arg("f"),
                                          py::arg("Q") = py::none(), py::kw_only(),
                                          py::arg("dt") = py::none(),
                                          R"(One step in time, [X21] (2.6).

Parameters
----------
f : callable, MotionModel or (n, n)
    f(x) -> (n,), the state moved; a built-in model, which runs in the core; or a matrix.
Q : (n, n), optional
    Process noise, positive semidefinite. Default, for a built-in model: its own over dt.
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
>>> filter = est.UnscentedKalmanFilter([0.0, 1.0], np.eye(2))
>>> filter.predict(lambda x: [x[0] + np.sin(x[1]), x[1]], 0.01 * np.eye(2))
True
>>> filter.predict(est.models.constant_velocity(1), dt=0.5)
True
>>> filter.x.round(3)
array([0.922, 1.   ])
)");
  QuickMethod<&update_unscented>::define(filter, "update", py::arg("z"), py::arg("h"), py::arg("R"),
                                         py::arg("gate") = py::none(), py::kw_only(),
                                         py::arg("angles") = py::tuple(),
                                         R"(A measurement z = h(x) + noise, [X21] (2.7), (2.8).

Parameters
----------
z : (m,), m up to 16
h : callable, MeasurementModel or (m, n)
    h(x) -> (m,), what is expected; a built-in model, which knows its angles; or a matrix.
R : (m, m)
    Measurement noise, positive semidefinite.
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
>>> filter = est.UnscentedKalmanFilter([0.0, 0.0, 0.0], np.eye(3), angles=(2,))
>>> filter.update([3.0, -0.1], est.models.range_bearing((3.0, 0.0)), 0.01 * np.eye(2))
True
>>> filter.status, round(filter.nis, 3)
('ok', 0.035)
)");
  filter.def(
      "run",
      [](Filter& self, const ArrayLike& record, const MotionLike& f, const MeasurementLike& h,
         const ArrayLike& R, const OptionalArray& Q, const OptionalArray& dt,
         const OptionalNumber& gate, const Indices& angles, bool smooth) {
        const auto f_jacobian = py::reinterpret_borrow<OptionalFunction>(py::none());
        const auto& h_jacobian = f_jacobian;
        return run_nonlinear(self, record, {f, f_jacobian, h, h_jacobian, Q, dt}, R, gate, angles,
                             smooth);
      },
      py::arg("record"), py::kw_only(), py::arg("f"), py::arg("h"), py::arg("R"),
      py::arg("Q") = py::none(), py::arg("dt") = py::none(), py::arg("gate") = py::none(),
      py::arg("angles") = py::tuple(), py::arg("smooth") = false,
      R"(Predict, then update, for each row of a record; with built-in models, in the core.

The filter is then where the record ends. Smoothing is the unscented one of Särkkä 2008.

Parameters
----------
record : (N, m), or (N,) for m = 1
    A row of NaN is no update.
f : callable, MotionModel, (n, n) or (N, n, n)
h : callable, MeasurementModel, (m, n) or (N, m, n)
R : (m, m) or (N, m, m)
Q : (n, n) or (N, n, n), optional
    Default, for a built-in model: its own over dt.
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
>>> filter = est.UnscentedKalmanFilter([0.0, 0.0], np.eye(2))
>>> run = filter.run([1.0, np.nan, 4.0], f=est.models.constant_velocity(1), dt=[1.0, 1.0, 2.0],
...                  h=[[1.0, 0.0]], R=[[0.01]], smooth=True)
>>> run.x_smooth[:, 0].round(2)
array([1. , 1.9, 4. ])
)");
}

}  // namespace thing_kin::python
