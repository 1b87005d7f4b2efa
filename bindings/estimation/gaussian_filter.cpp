#include "thing_kin/estimation/gaussian_filter.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <pybind11/stl.h>

#include "estimation_bindings.hpp"
#include "filter_arguments.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

// A copy, which is the caller's.
Array vector_copy(const StateVector& v) {
  const py::ssize_t size = v.size();
  Array array = make_array(&size, 1);
  std::copy_n(v.data(), size, array.mutable_data());
  return array;
}

Array matrix_copy(const StateMatrix& A) {
  const std::array<py::ssize_t, 2> shape{A.rows(), A.cols()};
  Array array = make_array(shape.data(), 2);
  write_matrix(A, array.mutable_data());
  return array;
}

template <typename Read>
OptionalResult of_last(const GaussianFilter& filter, const Read& read_last) {
  py::object result = py::none();
  if (filter.last().any) {
    result = read_last(filter.last());
  }
  return py::reinterpret_borrow<OptionalResult>(result);
}

template <typename Read>
OptionalNumber number_of_last(const GaussianFilter& filter, const Read& read_last) {
  if (!filter.last().any) {
    return py::reinterpret_borrow<OptionalNumber>(py::none());
  }
  return py::reinterpret_steal<OptionalNumber>(PyFloat_FromDouble(read_last(filter.last())));
}

void bind_last(py::class_<GaussianFilter>& filter) {
  filter
      .def_property_readonly(
          "innovation",
          [](const GaussianFilter& self) {
            return of_last(self, [](const FilterUpdate& u) { return vector_copy(u.innovation); });
          },
          "(m,), z minus what was expected, of the last update; None before the first.")
      .def_property_readonly(
          "S",
          [](const GaussianFilter& self) {
            return of_last(self, [](const FilterUpdate& u) { return matrix_copy(u.S); });
          },
          "(m, m), the innovation's covariance, [X21] (2.4); None before the first update.")
      .def_property_readonly(
          "K",
          [](const GaussianFilter& self) {
            return of_last(self, [](const FilterUpdate& u) { return matrix_copy(u.K); });
          },
          "(n, m), the gain, [X21] (2.4); None before the first update.")
      .def_property_readonly(
          "nis",
          [](const GaussianFilter& self) {
            return number_of_last(self, [](const FilterUpdate& u) { return u.nis; });
          },
          "Normalized innovation squared of the last update, chi-square of m; None before.")
      .def_property_readonly(
          "log_likelihood",
          [](const GaussianFilter& self) {
            return number_of_last(self, [](const FilterUpdate& u) { return u.log_likelihood(); });
          },
          "ln of the innovation's density, of the last update; None before the first.")
      .def_property_readonly(
          "accepted", [](const GaussianFilter& self) { return self.last().accepted; },
          "Whether the last update passed its gate and was made; False before the first.");
}

}  // namespace

void bind_gaussian_filter(py::module_& m) {
  py::class_<GaussianFilter> filter(
      m, "GaussianFilter", R"(What the filters share: a state, its covariance and the last update.

KalmanFilter, ExtendedKalmanFilter and UnscentedKalmanFilter are made, not this. What is read is a
copy; x and P can be set and are checked.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> filter = est.KalmanFilter([0.0, 0.0], np.eye(2))
>>> filter.x = [1.0, 2.0]
>>> isinstance(filter, est.GaussianFilter), filter.n
(True, 2)
)");
  filter.def_property_readonly("n", &GaussianFilter::size, "How many entries the state has.")
      .def_property(
          "x", [](const GaussianFilter& self) { return vector_copy(self.x()); },
          [](GaussianFilter& self, const ArrayLike& x) {
            StateVector state;
            read_into(x, "x", self.size(), state);
            self.set_x(state);
          },
          "(n,), the state; angles in (-pi, pi].")
      .def_property_readonly(
          "angles",
          [](const GaussianFilter& self) { return py::tuple(py::cast(self.angles().indices())); },
          "Which entries of the state are angles.")
      .def_property_readonly(
          "status", [](const GaussianFilter& self) { return std::string(name_of(self.status())); },
          "What came of the last step: 'ok'; or, with the state as it was, 'rejected' by the gate, "
          "'singular' (the innovation has no positive covariance), 'not_positive' (the covariance "
          "would not be) or 'not_finite' (numbers would overflow).");
  bind_last(filter);
}

}  // namespace thing_kin::python
