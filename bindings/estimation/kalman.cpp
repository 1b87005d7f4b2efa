#include "thing_kin/estimation/kalman.hpp"

#include <algorithm>

#include "estimation/filter_run.hpp"
#include "estimation_bindings.hpp"
#include "quick_method.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

// How many inputs B has.
py::ssize_t inputs_of(py::handle u, bool rows) {
  const std::vector<py::ssize_t> shape = read_shape(u, "u");
  const std::size_t axes = shape.size();
  if (axes < 1 || axes > (rows ? 2U : 1U)) {
    throw InvalidArgument("u", std::to_string(axes) + " axes", rows ? "(N, k) or (k,)" : "(k,)");
  }
  return shape.back();
}

void check_input(const OptionalArray& B, const OptionalArray& u) {
  if (B.is_none() != u.is_none()) {
    throw InvalidArgument(B.is_none() ? "B" : "u", "None", "both of B and u, or neither");
  }
}

void add_input(const double* B, const double* u, py::ssize_t n, py::ssize_t k,
               StateVector& offset) {
  offset.setZero(n);
  for (py::ssize_t i = 0; i < n; ++i) {
    for (py::ssize_t j = 0; j < k; ++j) {
      offset[i] += B[i * k + j] * u[j];
    }
  }
}

bool predict_kalman(KalmanFilter& self, const ArrayLike& F, const ArrayLike& Q,
                    const OptionalArray& B, const OptionalArray& u) {
  const int n = self.size();
  ModelMatrix transition;
  StateMatrix noise;
  read_into(F, "F", n, n, transition);
  read_into(Q, "Q", n, noise);
  StateVector offset;
  if (!B.is_none() || !u.is_none()) {
    check_input(B, u);
    const py::ssize_t k = inputs_of(u, false);
    const Batch inputs = read(u, "u", {k}, false);
    const Batch matrix = read(B, "B", {n, k}, false);
    add_input(matrix.data, inputs.data, n, k, offset);
  }
  return self.predict(transition, noise, offset) == FilterStatus::kOk;
}

bool update_kalman(KalmanFilter& self, const ArrayLike& z, const ArrayLike& H, const ArrayLike& R,
                   const OptionalNumber& gate, const Indices& angles) {
  StateVector measured;
  ModelMatrix matrix;
  StateMatrix noise;
  read_measurement(z, "z", measured);
  read_into(H, "H", measured.size(), self.size(), matrix);
  read_into(R, "R", measured.size(), noise);
  const AngleSet set = read_angles(angles, static_cast<int>(measured.size()));
  return self.update(measured, matrix, noise, {read_gate(gate), set}) == FilterStatus::kOk;
}

FilterRun run_kalman(KalmanFilter& self, const ArrayLike& record, const ArrayLike& F,
                     const ArrayLike& Q, const ArrayLike& H, const ArrayLike& R,
                     const OptionalArray& B, const OptionalArray& u, const OptionalNumber& gate,
                     const Indices& angles, bool smooth) {
  const int n = self.size();
  const Batch rows = read_record(record);
  const py::ssize_t m = rows.size;
  const py::ssize_t count = rows.count;
  const Rows transition(F, "F", {n, n}, count);
  const Rows noise(Q, "Q", {n, n}, count);
  const Rows matrix(H, "H", {m, n}, count);
  const RunArguments arguments{rows, Rows(R, "R", {m, m}, count), read_gate(gate), smooth};
  const UpdateOptions options{arguments.gate, read_angles(angles, static_cast<int>(m))};
  std::optional<Rows> inputs;
  std::optional<Rows> input_matrix;
  py::ssize_t k = 0;
  check_input(B, u);
  if (!B.is_none()) {
    k = inputs_of(u, true);
    inputs.emplace(u, "u", std::vector<py::ssize_t>{k}, count);
    input_matrix.emplace(B, "B", std::vector<py::ssize_t>{n, k}, count);
  }
  ModelMatrix A(n, n);
  ModelMatrix C(m, n);
  StateMatrix W(n, n);
  StateVector offset;
  const auto predict_row = [&](KalmanFilter& filter, py::ssize_t i) {
    std::copy_n(transition.at(i), n * n, A.data());
    std::copy_n(noise.at(i), n * n, W.data());
    if (inputs) {
      add_input(input_matrix->at(i), inputs->at(i), n, k, offset);
    }
    return filter.predict(A, W, offset);
  };
  const auto update_row = [&](KalmanFilter& filter, py::ssize_t i, const StateVector& z,
                              const StateMatrix& covariance) {
    std::copy_n(matrix.at(i), m * n, C.data());
    return filter.update(z, C, covariance, options);
  };
  return run_filter(self, arguments, false, predict_row, update_row);
}

}  // namespace

void bind_kalman(py::module_& m) {
  py::class_<KalmanFilter, GaussianFilter> filter(m, "KalmanFilter",
                                                  R"(The linear Kalman filter, [X21] (2.3) to (2.5).

The update is in Joseph's form, (I - K H) P (I - K H)^T + K R K^T, so that P stays symmetric and
positive. (2.4) misprints the gain, which is P H^T S^-1.

Parameters
----------
x : (n,), n up to 16
    The state.
P : (n, n)
    Its covariance, positive semidefinite.
angles : sequence of int
    Which entries of the state are angles: they are kept in (-pi, pi].

Raises
------
ValueError
    If an argument has another shape, is not finite or is no covariance; its name comes first.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> filter = est.KalmanFilter([0.0, 1.0], np.eye(2))
>>> filter.predict(F=[[1.0, 0.1], [0.0, 1.0]], Q=0.01 * np.eye(2))
True
>>> filter.update([0.2], H=[[1.0, 0.0]], R=[[0.5]])
True
>>> filter.x.round(4)
array([0.1671, 1.0066])
)");
  filter.def(py::init([](const ArrayLike& x, const ArrayLike& P, const Indices& angles) {
               const InitialState state(x, P, angles);
               return KalmanFilter(state.x, state.P, state.angles);
             }),
             py::arg("x"), py::arg("P"), py::kw_only(), py::arg("angles") = py::tuple());
  bind_covariance<KalmanFilter>(filter);
  QuickMethod<&predict_kalman>::define(
      filter, "predict", py::arg("F"), py::arg("Q"), py::arg("B") = py::none(),
      py::arg("u") = py::none(),
      R"(One step in time: x = F x + B u, P = F P F^T + Q, [X21] (2.3).

Parameters
----------
F : (n, n)
Q : (n, n)
    Process noise, positive semidefinite.
B : (n, k), optional
u : (k,), optional
    An input.

Returns
-------
bool
    Whether it was made; if not, the state is as it was, and status says why.

Raises
------
ValueError
    If an argument has another shape, is not finite or is no covariance; the state is as it was.

Examples
--------
>>> from thing_kin import estimation as est
>>> filter = est.KalmanFilter([1.0], [[1.0]])
>>> filter.predict([[1.0]], [[0.5]], B=[[2.0]], u=[3.0])
True
>>> filter.x, filter.P
(array([7.]), array([[1.5]]))
)");
  QuickMethod<&update_kalman>::define(
      filter, "update", py::arg("z"), py::arg("H"), py::arg("R"), py::arg("gate") = py::none(),
      py::kw_only(), py::arg("angles") = py::tuple(),
      R"(A measurement z = H x + noise, [X21] (2.4), (2.5), P in Joseph's form.

Parameters
----------
z : (m,), m up to 16
H : (m, n)
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
    If an argument has another shape, is not finite, is no covariance or no probability; the state is
    as it was.

Examples
--------
>>> from thing_kin import estimation as est
>>> filter = est.KalmanFilter([0.0], [[1.0]])
>>> filter.update([9.0], [[1.0]], [[1.0]], gate=0.99)
False
>>> round(filter.nis, 6), filter.status
(40.5, 'rejected')
)");
  filter.def("run", &run_kalman, py::arg("record"), py::kw_only(), py::arg("F"), py::arg("Q"),
             py::arg("H"), py::arg("R"), py::arg("B") = py::none(), py::arg("u") = py::none(),
             py::arg("gate") = py::none(), py::arg("angles") = py::tuple(),
             py::arg("smooth") = false,
             R"(Predict, then update, for each row of a record, in the core.

The filter is then where the record ends. Smoothing is that of Rauch, Tung & Striebel.

Parameters
----------
record : (N, m), or (N,) for m = 1
    A row of NaN is no update.
F : (n, n) or (N, n, n)
Q : (n, n) or (N, n, n)
H : (m, n) or (N, m, n)
R : (m, m) or (N, m, m)
B : (n, k) or (N, n, k), optional
u : (k,) or (N, k), optional
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
>>> from thing_kin import estimation as est
>>> filter = est.KalmanFilter([0.0], [[1.0]])
>>> run = filter.run([1.0, 2.0], F=[[1.0]], Q=[[0.0]], H=[[1.0]], R=[[1.0]], smooth=True)
>>> run.x.ravel(), run.x_smooth.ravel()
(array([0.5, 1. ]), array([1., 1.]))
)");
}

}  // namespace thing_kin::python
