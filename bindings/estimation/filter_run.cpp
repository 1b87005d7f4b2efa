#include "thing_kin/estimation/filter_run.hpp"

#include <array>
#include <string>

#include "estimation/filter_run.hpp"
#include "estimation_bindings.hpp"

namespace thing_kin::python {

namespace {

Array empty_array(std::initializer_list<py::ssize_t> shape) {
  return make_array(shape.begin(), static_cast<int>(shape.size()));
}

double* writable(const py::object& array) {
  return array.is_none() ? nullptr : py::reinterpret_borrow<Array>(array).mutable_data();
}

py::list status_names(const FilterRun& run) {
  py::list list;
  for (const FilterStatus status : run.status) {
    list.append(name_of(status));
  }
  return list;
}

std::string shown_run(const FilterRun& run) {
  const py::ssize_t count = run.x.shape(0);
  py::ssize_t accepted = 0;
  for (const FilterStatus status : run.status) {
    accepted += status == FilterStatus::kOk ? 1 : 0;
  }
  return std::string("FilterRun(")
      .append(std::to_string(count))
      .append(" rows, ")
      .append(std::to_string(accepted))
      .append(" accepted)");
}

}  // namespace

FilterRun::FilterRun(int n, int m, py::ssize_t count, bool smooth)
    : x(empty_array({count, n})),
      P(empty_array({count, n, n})),
      innovations(empty_array({count, m})),
      nis(empty_array({count})),
      accepted(count),
      status(static_cast<std::size_t>(count)),
      x_smooth(py::none()),
      P_smooth(py::none()) {
  if (smooth) {
    x_smooth = empty_array({count, n});
    P_smooth = empty_array({count, n, n});
  }
}

RunOutput FilterRun::output() {
  RunOutput out;
  out.x = x.mutable_data();
  out.P = P.mutable_data();
  out.innovation = innovations.mutable_data();
  out.nis = nis.mutable_data();
  out.status = status.data();
  out.x_smooth = writable(x_smooth);
  out.P_smooth = writable(P_smooth);
  return out;
}

void bind_filter_run(py::module_& m) {
  py::class_<FilterRun>(m, "FilterRun", R"(A record of N rows, filtered.

Each row is the state after its prediction and its update. What a filter's run() returns.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> filter = est.KalmanFilter([0.0], [[1.0]])
>>> run = filter.run([1.0, np.nan, 2.0], F=[[1.0]], Q=[[0.1]], H=[[1.0]], R=[[1.0]])
>>> run
FilterRun(3 rows, 2 accepted)
>>> run.status
['ok', 'missing', 'ok']
>>> bool((run.x[-1] == filter.x).all())
True
)")
      .def_readonly("x", &FilterRun::x, "(N, n), the states.")
      .def_readonly("P", &FilterRun::P, "(N, n, n), their covariances.")
      .def_readonly("innovations", &FilterRun::innovations,
                    "(N, m), z minus what was expected; NaN in rows without a measurement.")
      .def_readonly("nis", &FilterRun::nis,
                    "(N,), normalized innovations squared; NaN in rows without a measurement.")
      .def_readonly("accepted", &FilterRun::accepted, "(N,) of bool: there was an update.")
      .def_property_readonly(
          "status", &status_names,
          "What came of each row: 'ok', 'missing', 'rejected' by the gate, or why "
          "a step was not made, as GaussianFilter.status.")
      .def_readonly("log_likelihood", &FilterRun::log_likelihood,
                    "The sum over the accepted measurements.")
      .def_property_readonly(
          "x_smooth",
          [](const FilterRun& run) { return py::reinterpret_borrow<OptionalResult>(run.x_smooth); },
          "(N, n), smoothed; None unless asked for.")
      .def_property_readonly(
          "P_smooth",
          [](const FilterRun& run) { return py::reinterpret_borrow<OptionalResult>(run.P_smooth); },
          "(N, n, n), smoothed; None unless asked for.")
      .def("__len__", [](const FilterRun& run) { return run.x.shape(0); })
      .def("__repr__", &shown_run);
}

}  // namespace thing_kin::python
