#pragma once

// What the filters' bindings share: arguments of a step, and models that are built in, a matrix or
// Python functions.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "array.hpp"
#include "thing_kin/estimation/unscented_kalman.hpp"

namespace thing_kin::python {

/// A motion model, a matrix or a function.
class MotionLike : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(MotionLike, object, [](PyObject*) { return 1; })
};

/// A measurement model, a matrix or a function.
class MeasurementLike : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(MeasurementLike, object, [](PyObject*) { return 1; })
};

/// None or a function that returns an array.
class OptionalFunction : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(OptionalFunction, object, [](PyObject*) { return 1; })
};

/// None or a number.
class OptionalNumber : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(OptionalNumber, object, [](PyObject*) { return 1; })
};

/// A result that may be missing.
class OptionalResult : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(OptionalResult, object, [](PyObject*) { return 1; })
};

/// Indices.
class Indices : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(Indices, object, [](PyObject*) { return 1; })
};

void read_into(py::handle argument, const char* name, py::ssize_t size, StateVector& out);
void read_into(py::handle argument, const char* name, py::ssize_t rows, py::ssize_t cols,
               ModelMatrix& out);
/// A square matrix that the core will check: for NaN too.
void read_into(py::handle argument, const char* name, py::ssize_t size, StateMatrix& out);
/// A vector of any size up to kMaxState, or a number.
void read_measurement(py::handle argument, const char* name, StateVector& out);
double read_gate(const OptionalNumber& gate);
double read_number(py::handle number, const char* name);
AngleSet read_angles(const Indices& angles, int n);

/// A matrix for all rows of a record, or one for each.
struct Rows {
  Batch batch;

  Rows(py::handle argument, const char* name, const std::vector<py::ssize_t>& item,
       py::ssize_t count);
  const double* at(py::ssize_t i) const { return batch.item(batch.single ? 0 : i); }
};

/// As numpy.shape(). Throws InvalidArgument for what is no array.
std::vector<py::ssize_t> read_shape(py::handle argument, const char* name);

/// (N, m) with rows of NaN for what is missing, or (N,) for m = 1.
Batch read_record(py::handle record);

/// An argument f, taken apart.
class Motion {
 public:
  /// `count`: rows of a record, 0 for a single step. Throws InvalidArgument("f" or "jacobian",
  /// ...).
  Motion(const MotionLike& f, const OptionalFunction& jacobian, const char* jacobian_name, int n,
         py::ssize_t count = 0);

  bool calls_python() const noexcept { return static_cast<bool>(function_); }
  bool is_model() const noexcept { return model_ != nullptr; }
  /// Q == nullptr for the model's own; row i of a record. Without the GIL if !calls_python().
  FilterStatus predict(ExtendedKalmanFilter& filter, const StateMatrix* Q, double dt,
                       py::ssize_t i = 0) const;
  FilterStatus predict(UnscentedKalmanFilter& filter, const StateMatrix* Q, double dt,
                       py::ssize_t i = 0) const;

 private:
  void matrix(py::ssize_t i, ModelMatrix& F) const;

  int n_;
  const MotionModel* model_ = nullptr;
  std::optional<Rows> rows_;
  py::object function_, jacobian_;
  const char* jacobian_name_;
};

/// An argument h, taken apart.
class Sensor {
 public:
  Sensor(const MeasurementLike& h, const OptionalFunction& jacobian, const char* jacobian_name,
         const Indices& angles, int n, int m, py::ssize_t count = 0);

  bool calls_python() const noexcept { return static_cast<bool>(function_); }
  FilterStatus update(ExtendedKalmanFilter& filter, const StateVector& z, const StateMatrix& R,
                      double gate, py::ssize_t i = 0) const;
  FilterStatus update(UnscentedKalmanFilter& filter, const StateVector& z, const StateMatrix& R,
                      double gate, py::ssize_t i = 0) const;

 private:
  void matrix(py::ssize_t i, ModelMatrix& H) const;

  int n_, m_;
  const MeasurementModel* model_ = nullptr;
  std::optional<Rows> rows_;
  py::object function_, jacobian_;
  const char* jacobian_name_;
  AngleSet angles_;
};

/// Seconds: needed by a built-in model, refused by anything else.
double read_dt(const OptionalNumber& dt, const Motion& motion);

/// A copy of a covariance, which is the caller's.
Array covariance_copy(const StateMatrix& P);

/// The property P of a filter; setting it is checked by the filter's own class.
template <typename Filter, typename Class>
void bind_covariance(Class& filter) {
  filter.def_property(
      "P", [](const Filter& self) { return covariance_copy(self.P()); },
      [](Filter& self, const ArrayLike& P) {
        StateMatrix covariance;
        read_into(P, "P", self.size(), covariance);
        self.set_P(covariance);
      },
      "(n, n), the state's covariance: symmetric and positive definite, but for variances of "
      "zero.");
}

/// What the constructors read.
struct InitialState {
  StateVector x;
  StateMatrix P;
  AngleSet angles;

  InitialState(const ArrayLike& x_argument, const ArrayLike& P_argument, const Indices& a) {
    read_measurement(x_argument, "x", x);
    read_into(P_argument, "P", x.size(), P);
    angles = read_angles(a, static_cast<int>(x.size()));
  }
};

/// Q if it was given; nullptr for the noise of a built-in model.
const StateMatrix* read_noise(const OptionalArray& Q, const Motion& motion, int n,
                              StateMatrix& storage);

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::MotionLike> {
  static constexpr auto name = const_name(
      "MotionModel | numpy.typing.ArrayLike | "
      "collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike]");
};

template <>
struct handle_type_name<thing_kin::python::MeasurementLike> {
  static constexpr auto name = const_name(
      "MeasurementModel | numpy.typing.ArrayLike | "
      "collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike]");
};

template <>
struct handle_type_name<thing_kin::python::OptionalFunction> {
  static constexpr auto name = const_name(
      "collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike] | "
      "None");
};

template <>
struct handle_type_name<thing_kin::python::OptionalResult> {
  static constexpr auto name = const_name("numpy.typing.NDArray[numpy.float64] | None");
};

template <>
struct handle_type_name<thing_kin::python::OptionalNumber> {
  static constexpr auto name = const_name("float | None");
};

template <>
struct handle_type_name<thing_kin::python::Indices> {
  static constexpr auto name = const_name("collections.abc.Sequence[int]");
};

}  // namespace pybind11::detail
