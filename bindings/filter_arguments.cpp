#include "filter_arguments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "quick_method.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/estimation/numeric_jacobian.hpp"

namespace thing_kin::python {

namespace {

std::string type_name(py::handle object) { return py::str(py::type::of(object).attr("__name__")); }

// The built-in model behind an argument; final classes, so that a look at the type will do.
template <typename Model>
const Model* model_in(py::handle argument) {
  static PyObject* const type = py::type::of<Model>().release().ptr();
  return object_of<Model>(argument.ptr(), reinterpret_cast<PyTypeObject*>(type));
}

void check_function(py::handle function, const char* name) {
  if (!function.is_none() && PyCallable_Check(function.ptr()) == 0) {
    throw InvalidArgument(name, type_name(function), "a function or None");
  }
}

// Its own copy each time, which the user's function may keep.
Array to_array(const double* x, int n) {
  const std::array<py::ssize_t, 1> shape{n};
  Array array = make_array(shape.data(), 1);
  std::copy_n(x, n, array.mutable_data());
  return array;
}

void call_user(const py::object& function, const double* x, int n, const char* name, int rows,
               double* out) {
  StateVector value(rows);
  read_into(function(to_array(x, n)), name, rows, value);
  std::copy_n(value.data(), rows, out);
}

// The Jacobian of a user's function by the user's or by differences.
void differentiate(const py::object& function, const py::object& jacobian, const char* name,
                   const char* value_name, const StateVector& x, int rows, const AngleSet& angles,
                   ModelMatrix& J) {
  const auto n = static_cast<int>(x.size());
  if (!jacobian.is_none()) {
    read_into(jacobian(to_array(x.data(), n)), name, rows, n, J);
    return;
  }
  J.resize(rows, n);
  numeric_jacobian(
      [&](const double* at, double* out) { call_user(function, at, n, value_name, rows, out); }, x,
      rows, angles, J.data());
}

void times(const ModelMatrix& A, const double* x, double* out) noexcept {
  const Eigen::Index n = A.cols();
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < n; ++j) {
      sum += A.data()[i * n + j] * x[j];
    }
    out[i] = sum;
  }
}

constexpr const char* kAngles = "a sequence of different indices";

}  // namespace

void read_into(py::handle argument, const char* name, py::ssize_t size, StateVector& out) {
  out.resize(size);
  if (!read_plain(argument, {size}, out.data())) {
    const Batch batch = read(argument, name, {size}, false);
    std::copy_n(batch.data, size, out.data());
  }
}

void read_into(py::handle argument, const char* name, py::ssize_t rows, py::ssize_t cols,
               ModelMatrix& out) {
  out.resize(rows, cols);
  if (!read_plain(argument, {rows, cols}, out.data())) {
    const Batch batch = read(argument, name, {rows, cols}, false);
    std::copy_n(batch.data, rows * cols, out.data());
  }
}

void read_into(py::handle argument, const char* name, py::ssize_t size, StateMatrix& out) {
  out.resize(size, size);
  if (!copy_plain(argument, {size, size}, out.data())) {
    const Batch batch = read(argument, name, {size, size}, false);
    std::copy_n(batch.data, size * size, out.data());
  }
}

void read_measurement(py::handle argument, const char* name, StateVector& out) {
  const auto& api = py::detail::npy_api::get();
  if (api.PyArray_Check_(argument.ptr())) {
    const auto* array = py::detail::array_proxy(argument.ptr());
    if (array->nd == 1 && array->dimensions[0] >= 1 && array->dimensions[0] <= kMaxState) {
      read_into(argument, name, array->dimensions[0], out);
      return;
    }
  }
  const Batch batch = read(argument, name, {});
  if (batch.count < 1 || batch.count > kMaxState) {
    throw InvalidArgument(name, std::to_string(batch.count) + " entries",
                          "1 to " + std::to_string(kMaxState));
  }
  out = Eigen::Map<const Eigen::VectorXd>(batch.data, batch.count);
}

double read_number(py::handle number, const char* name) {
  if (PyFloat_CheckExact(number.ptr())) {
    const double value = PyFloat_AS_DOUBLE(number.ptr());
    if (std::isfinite(value)) {
      return value;
    }
  }
  return *read(number, name, {}, false).data;
}

double read_gate(const OptionalNumber& gate) {
  return gate.is_none() ? 1.0 : read_number(gate, "gate");
}

AngleSet read_angles(const Indices& angles, int n) {
  if (PyTuple_CheckExact(angles.ptr()) && PyTuple_GET_SIZE(angles.ptr()) == 0) {
    return {};
  }
  std::vector<int> indices;
  try {
    indices = angles.cast<std::vector<int>>();
  } catch (const py::cast_error&) {
    throw InvalidArgument("angles", py::repr(angles), kAngles);
  }
  return {indices, n};
}

Rows::Rows(py::handle argument, const char* name, const std::vector<py::ssize_t>& item,
           py::ssize_t count)
    : batch(read(argument, name, item, count > 0)) {
  if (!batch.single && batch.count != count) {
    throw InvalidArgument(
        name, std::to_string(batch.count) + " rows",
        "one for all, or one for each row of the record, " + std::to_string(count));
  }
}

std::vector<py::ssize_t> read_shape(py::handle argument, const char* name) {
  try {
    return py::module_::import("numpy").attr("shape")(argument).cast<std::vector<py::ssize_t>>();
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_Exception) || error.matches(PyExc_MemoryError)) {
      throw;
    }
    throw InvalidArgument(name, type_name(argument), "an array of real numbers");
  }
}

Batch read_record(py::handle record) {
  const std::vector<py::ssize_t> shape = read_shape(record, "record");
  const bool table = shape.size() == 2 && shape[1] >= 1 && shape[1] <= kMaxState;
  if (!(table || shape.size() == 1) || shape[0] < 1) {
    throw InvalidArgument(
        "record", "shape " + shape_text(shape.data(), static_cast<py::ssize_t>(shape.size())),
        "(N, m) with 1 <= m <= " + std::to_string(kMaxState) + ", or (N,)");
  }
  Batch batch = table ? read(record, "record", {shape[1]}, true, Finite::kNo)
                      : read(record, "record", {}, true, Finite::kNo);
  for (py::ssize_t i = 0; i < batch.count; ++i) {
    const double* row = batch.item(i);
    const auto missing =
        std::count_if(row, row + batch.size, [](double z) { return std::isnan(z); });
    const bool infinite =
        std::any_of(row, row + batch.size, [](double z) { return std::isinf(z); });
    if (infinite || (missing > 0 && missing < batch.size)) {
      throw InvalidArgument("record",
                            std::string(infinite ? "infinity" : "NaN beside numbers")
                                .append(" in row ")
                                .append(std::to_string(i)),
                            "finite numbers, or a row of NaN where nothing was measured");
    }
  }
  return batch;
}

Motion::Motion(const MotionLike& f, const OptionalFunction& jacobian, const char* jacobian_name,
               int n, py::ssize_t count)
    : n_(n), model_(model_in<MotionModel>(f)), jacobian_name_(jacobian_name) {
  if (model_ != nullptr || PyCallable_Check(f.ptr()) == 0) {
    if (!jacobian.is_none()) {
      throw InvalidArgument(jacobian_name, "one for a model that has its own", "None");
    }
    if (model_ == nullptr) {
      rows_.emplace(f, "f", std::vector<py::ssize_t>{n, n}, count);
    }
    return;
  }
  check_function(jacobian, jacobian_name);
  function_ = f;
  jacobian_ = jacobian;
}

void Motion::matrix(py::ssize_t i, ModelMatrix& F) const {
  F = Eigen::Map<const ModelMatrix>(rows_->at(i), n_, n_);
}

FilterStatus Motion::predict(ExtendedKalmanFilter& filter, const StateMatrix* Q, double dt,
                             py::ssize_t i) const {
  if (model_ != nullptr) {
    return filter.predict(*model_, dt, Q);
  }
  StateVector fx(n_);
  ModelMatrix F;
  if (rows_) {
    matrix(i, F);
    times(F, filter.x().data(), fx.data());
  } else {
    const StateVector& x = filter.x();
    call_user(function_, x.data(), n_, "f(x)", n_, fx.data());
    differentiate(function_, jacobian_, jacobian_name_, "f(x)", x, n_, filter.angles(), F);
  }
  return filter.predict(fx, F, *Q);
}

FilterStatus Motion::predict(UnscentedKalmanFilter& filter, const StateMatrix* Q, double dt,
                             py::ssize_t i) const {
  if (model_ != nullptr) {
    return filter.predict(*model_, dt, Q);
  }
  SigmaPoints X;
  filter.sigma_points(X);
  SigmaPoints Y(n_, X.cols());
  ModelMatrix F;
  if (rows_) {
    matrix(i, F);
  }
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    double* const to = Y.data() + k * n_;
    if (rows_) {
      times(F, X.data() + k * n_, to);
    } else {
      call_user(function_, X.data() + k * n_, n_, "f(x)", n_, to);
    }
  }
  return filter.predict(Y, *Q);
}

Sensor::Sensor(const MeasurementLike& h, const OptionalFunction& jacobian,
               const char* jacobian_name, const Indices& angles, int n, int m, py::ssize_t count)
    : n_(n),
      m_(m),
      model_(model_in<MeasurementModel>(h)),
      jacobian_name_(jacobian_name),
      angles_(read_angles(angles, m)) {
  if (model_ != nullptr && !angles_.empty() && !(angles_ == model_->angles())) {
    throw InvalidArgument("angles", py::repr(angles), "none for a model that knows its own");
  }
  if (model_ != nullptr || PyCallable_Check(h.ptr()) == 0) {
    if (!jacobian.is_none()) {
      throw InvalidArgument(jacobian_name, "one for a model that has its own", "None");
    }
    if (model_ == nullptr) {
      rows_.emplace(h, "h", std::vector<py::ssize_t>{m, n}, count);
    }
    return;
  }
  check_function(jacobian, jacobian_name);
  function_ = h;
  jacobian_ = jacobian;
}

void Sensor::matrix(py::ssize_t i, ModelMatrix& H) const {
  H = Eigen::Map<const ModelMatrix>(rows_->at(i), m_, n_);
}

FilterStatus Sensor::update(ExtendedKalmanFilter& filter, const StateVector& z,
                            const StateMatrix& R, double gate, py::ssize_t i) const {
  if (model_ != nullptr) {
    return filter.update(z, *model_, R, gate);
  }
  StateVector hx(m_);
  ModelMatrix H;
  if (rows_) {
    matrix(i, H);
    times(H, filter.x().data(), hx.data());
  } else {
    const StateVector& x = filter.x();
    call_user(function_, x.data(), n_, "h(x)", m_, hx.data());
    differentiate(function_, jacobian_, jacobian_name_, "h(x)", x, m_, angles_, H);
  }
  return filter.update(z, hx, H, R, {gate, angles_});
}

FilterStatus Sensor::update(UnscentedKalmanFilter& filter, const StateVector& z,
                            const StateMatrix& R, double gate, py::ssize_t i) const {
  if (model_ != nullptr) {
    return filter.update(z, *model_, R, gate);
  }
  SigmaPoints X;
  filter.sigma_points(X);
  SigmaPoints Z(m_, X.cols());
  ModelMatrix H;
  if (rows_) {
    matrix(i, H);
  }
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    if (rows_) {
      times(H, X.data() + k * n_, Z.data() + k * m_);
    } else {
      call_user(function_, X.data() + k * n_, n_, "h(x)", m_, Z.data() + k * m_);
    }
  }
  return filter.update(z, Z, R, {gate, angles_});
}

Array covariance_copy(const StateMatrix& P) {
  const std::array<py::ssize_t, 2> shape{P.rows(), P.cols()};
  Array array = make_array(shape.data(), 2);
  std::copy_n(P.data(), P.size(), array.mutable_data());  // symmetric: rows are columns
  return array;
}

double read_dt(const OptionalNumber& dt, const Motion& motion) {
  if (dt.is_none() == motion.is_model()) {
    throw InvalidArgument("dt", dt.is_none() ? "None" : "a number",
                          dt.is_none() ? "the seconds that a built-in model moves"
                                       : "None: only built-in models move in time");
  }
  return dt.is_none() ? 0.0 : read_number(dt, "dt");
}

const StateMatrix* read_noise(const OptionalArray& Q, const Motion& motion, int n,
                              StateMatrix& storage) {
  if (Q.is_none()) {
    if (!motion.is_model()) {
      throw InvalidArgument("Q", "None", "a covariance: only built-in models have their own");
    }
    return nullptr;
  }
  read_into(Q, "Q", n, storage);
  return &storage;
}

}  // namespace thing_kin::python
