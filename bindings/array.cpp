#include "array.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "thing_kin/core/error.hpp"
#include "thing_kin/core/finite.hpp"
#include "thing_kin/core/tolerance.hpp"

namespace thing_kin::python {

namespace {

// A conversion that loses nothing a user could have meant: numbers that are real, of any width.
py::array to_float64(py::handle argument, const char* name, bool matrix) {
  try {
    const py::module_ numpy = py::module_::import("numpy");
    const auto array = numpy
                           .attr("asarray")(matrix ? as_matrix(argument)
                                                   : py::reinterpret_borrow<py::object>(argument))
                           .cast<py::array>();
    const char kind = array.dtype().kind();
    if (kind != 'f' && kind != 'i' && kind != 'u') {
      throw InvalidArgument(name, "dtype " + std::string(py::str(array.dtype())), "real numbers");
    }
    return numpy.attr("asarray")(array, py::arg("dtype") = "float64", py::arg("order") = "C")
        .cast<py::array>();
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_Exception) || error.matches(PyExc_MemoryError)) {
      throw;
    }
    throw InvalidArgument(name, py::str(py::type::of(argument).attr("__name__")),
                          "an array of real numbers");
  }
}

void check_finite(const Batch& batch, const char* name) {
  const py::ssize_t total = batch.count * batch.size;
  if (all_finite(batch.data, static_cast<std::size_t>(total))) {
    return;
  }
  for (py::ssize_t i = 0; i < total; ++i) {
    if (!std::isfinite(batch.data[i])) {
      throw InvalidArgument(name, text(batch.data[i]) + " at flat index " + std::to_string(i),
                            "finite numbers");
    }
  }
}

// What numpy would make of a list or tuple of numbers, without the way there; nothing of anything
// else.
py::object from_numbers(py::handle argument) {
  const bool tuple = PyTuple_CheckExact(argument.ptr());
  if (!tuple && !PyList_CheckExact(argument.ptr())) {
    return {};
  }
  const py::ssize_t count = Py_SIZE(argument.ptr());
  Array array = make_array(&count, 1);
  auto* const out = reinterpret_cast<double*>(py::detail::array_proxy(array.ptr())->data);
  for (py::ssize_t i = 0; i < count; ++i) {
    PyObject* const number =
        tuple ? PyTuple_GET_ITEM(argument.ptr(), i) : PyList_GET_ITEM(argument.ptr(), i);
    if (!PyFloat_CheckExact(number)) {
      return {};
    }
    out[i] = PyFloat_AS_DOUBLE(number);
  }
  return array;
}

// The array behind an argument: itself if it is C-ordered float64, else a converted copy.
py::object as_float64(py::handle argument, const char* name, bool matrix = false) {
  const auto& api = py::detail::npy_api::get();
  static PyObject* const float64 = py::dtype::of<double>().release().ptr();
  if (api.PyArray_Check_(argument.ptr())) {
    const auto* array = py::detail::array_proxy(argument.ptr());
    constexpr int kReadable =
        py::detail::npy_api::NPY_ARRAY_C_CONTIGUOUS_ | py::detail::npy_api::NPY_ARRAY_ALIGNED_;
    if (array->descr == float64 && (array->flags & kReadable) == kReadable) {
      return py::reinterpret_borrow<py::object>(argument);
    }
  }
  py::object numbers = from_numbers(argument);
  return numbers ? numbers : to_float64(argument, name, matrix);
}

}  // namespace

py::object as_matrix(py::handle argument) {
  if (py::hasattr(argument, "as_matrix")) {
    return argument.attr("as_matrix")();
  }
  // The rotation of a zero quaternion would be the identity.
  if (py::hasattr(argument, "toRotationMatrix") && argument.attr("norm")().cast<double>() > 0.5) {
    return argument.attr("toRotationMatrix")();
  }
  if (py::hasattr(argument, "isSE") && py::hasattr(argument, "A")) {
    return argument.attr("A");
  }
  return py::reinterpret_borrow<py::object>(argument);
}

std::string shape_text(const py::ssize_t* lengths, py::ssize_t dimensions, bool stack) {
  std::string text(stack ? "(N" : "(");
  for (py::ssize_t i = 0; i < dimensions; ++i) {
    text.append(i > 0 || stack ? ", " : "").append(std::to_string(lengths[i]));
  }
  return text.append(dimensions + (stack ? 1 : 0) == 1 ? ",)" : ")");
}

Batch read(py::handle argument, const char* name, const std::vector<py::ssize_t>& item,
           bool batches, Finite finite) {
  Batch batch;
  batch.owner = as_float64(argument, name, item.size() == 2);
  const auto* array = py::detail::array_proxy(batch.owner.ptr());
  const auto dimensions = static_cast<py::ssize_t>(item.size());
  const py::ssize_t lead = array->nd - dimensions;
  bool fits = lead == 0 || (lead == 1 && batches);
  for (py::ssize_t i = 0; fits && i < dimensions; ++i) {
    fits = array->dimensions[lead + i] == item[static_cast<std::size_t>(i)];
  }
  if (!fits) {
    std::string expected = dimensions == 0 ? "a number" : shape_text(item.data(), dimensions);
    if (batches) {
      expected += " or " + shape_text(item.data(), dimensions, true);
    }
    throw InvalidArgument(name, "shape " + shape_text(array->dimensions, array->nd), expected);
  }
  batch.data = reinterpret_cast<const double*>(array->data);
  batch.single = lead == 0;
  batch.count = batch.single ? 1 : array->dimensions[0];
  for (const py::ssize_t length : item) {
    batch.size *= length;
  }
  if (finite == Finite::kYes) {
    check_finite(batch, name);
  }
  return batch;
}

namespace {

bool copy_floats(py::handle argument, py::ssize_t count, double* out) noexcept {
  const bool tuple = PyTuple_CheckExact(argument.ptr());
  if (!(tuple || PyList_CheckExact(argument.ptr())) || Py_SIZE(argument.ptr()) != count) {
    return false;
  }
  for (py::ssize_t i = 0; i < count; ++i) {
    PyObject* const number =
        tuple ? PyTuple_GET_ITEM(argument.ptr(), i) : PyList_GET_ITEM(argument.ptr(), i);
    if (!PyFloat_CheckExact(number)) {
      return false;
    }
    out[i] = PyFloat_AS_DOUBLE(number);
  }
  return true;
}

py::ssize_t count_of(std::initializer_list<py::ssize_t> shape) {
  py::ssize_t count = 1;
  for (const py::ssize_t length : shape) {
    count *= length;
  }
  return count;
}

// A C-ordered float64 array in its own memory; nullptr if it is none of this shape.
const double* plain_data(py::handle argument, std::initializer_list<py::ssize_t> shape) {
  const auto& api = py::detail::npy_api::get();
  static PyObject* const float64 = py::dtype::of<double>().release().ptr();
  if (!api.PyArray_Check_(argument.ptr())) {
    return nullptr;
  }
  const auto* array = py::detail::array_proxy(argument.ptr());
  constexpr int kReadable =
      py::detail::npy_api::NPY_ARRAY_C_CONTIGUOUS_ | py::detail::npy_api::NPY_ARRAY_ALIGNED_;
  const bool plain = array->descr == float64 && (array->flags & kReadable) == kReadable &&
                     std::cmp_equal(array->nd, shape.size()) &&
                     std::equal(shape.begin(), shape.end(), array->dimensions);
  return plain ? reinterpret_cast<const double*>(array->data) : nullptr;
}

}  // namespace

bool copy_plain(py::handle argument, std::initializer_list<py::ssize_t> shape,
                double* out) noexcept {
  const double* const data = plain_data(argument, shape);
  if (data != nullptr) {
    std::copy_n(data, count_of(shape), out);
  }
  return data != nullptr;
}

bool read_plain(py::handle argument, std::initializer_list<py::ssize_t> shape,
                double* out) noexcept {
  const py::ssize_t count = count_of(shape);
  const bool copied =
      copy_plain(argument, shape, out) || (shape.size() == 1 && copy_floats(argument, count, out));
  return copied && all_finite(out, static_cast<std::size_t>(count));
}

SmallVector read_number_or_vector(py::handle argument, const char* name, py::ssize_t n,
                                  Finite finite) {
  const py::object owner = as_float64(argument, name);
  if (py::detail::array_proxy(owner.ptr())->nd == 0) {
    return SmallVector::Constant(n, *read(owner, name, {}, false, finite).data);
  }
  return vector_at(read(owner, name, {n}, false, finite), 0);
}

void check_magnitude(const Batch& batch, const char* name) {
  constexpr double kLargest = 1e50;
  for (py::ssize_t i = 0; i < batch.count * batch.size; ++i) {
    if (std::abs(batch.data[i]) > kLargest) {
      throw InvalidArgument(name, text(batch.data[i]), "numbers up to " + text(kLargest));
    }
  }
}

Batch read_vectors(py::handle argument, const char* name, py::ssize_t n) {
  Batch batch;
  batch.owner = as_float64(argument, name);
  const auto* array = py::detail::array_proxy(batch.owner.ptr());
  if (array->nd == 1 && array->dimensions[0] == n) {
    batch.data = reinterpret_cast<const double*>(array->data);
    batch.size = n;
    check_finite(batch, name);
    return batch;
  }
  return read(argument, name, {n});
}

Batch read_matrices(py::handle argument, const char* name, py::ssize_t& rows, py::ssize_t& cols) {
  const py::object owner = as_float64(argument, name);
  const auto* array = py::detail::array_proxy(owner.ptr());
  const int nd = array->nd;
  const auto fits = [&](int axis) {
    return array->dimensions[axis] >= 1 && array->dimensions[axis] <= kMaxDof;
  };
  if (nd < 2 || nd > 3 || !fits(nd - 1) || !fits(nd - 2)) {
    const std::string most = std::to_string(kMaxDof);
    throw InvalidArgument(name, "shape " + shape_text(array->dimensions, nd),
                          "(m, n) or (N, m, n) with 1 <= m, n <= " + most);
  }
  rows = array->dimensions[nd - 2];
  cols = array->dimensions[nd - 1];
  return read(owner, name, {rows, cols});
}

Array make_array(const py::ssize_t* shape, int dimensions) {
  const auto& api = py::detail::npy_api::get();
  static PyObject* const float64 = py::dtype::of<double>().release().ptr();
  Py_INCREF(float64);  // the call below steals a reference
  PyObject* array =
      api.PyArray_NewFromDescr_(api.PyArray_Type_, float64, dimensions,
                                const_cast<Py_intptr_t*>(shape), nullptr, nullptr, 0, nullptr);
  if (array == nullptr) {
    throw py::error_already_set();
  }
  return py::reinterpret_steal<Array>(array);
}

Shape shape_of(const Batch& batch, std::initializer_list<py::ssize_t> item) {
  Shape shape{{batch.count}, batch.single ? 0 : 1};
  for (const py::ssize_t length : item) {
    shape.lengths[static_cast<std::size_t>(shape.dimensions++)] = length;
  }
  return shape;
}

Array make_array(const Batch& batch, std::initializer_list<py::ssize_t> item) {
  const Shape shape = shape_of(batch, item);
  return make_array(shape.lengths.data(), shape.dimensions);
}

Array frozen(const JointVector& v) {
  Array array(v.size(), v.data());
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

Eigen::Matrix3d read_rotation(const double* row_major, const char* name) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = Eigen::Map<const RowMajor>(row_major);
  if (!is_rigid(T)) {
    throw InvalidArgument(name, "a (3, 3) matrix that is no rotation",
                          "R^T R = I within 1e-6 and det R = 1");
  }
  return T.topLeftCorner<3, 3>();
}

SE3 read_pose(const double* row_major, const char* name) {
  using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Eigen::Matrix4d T = Eigen::Map<const RowMajor>(row_major);
  if (!is_rigid(T)) {
    throw InvalidArgument(name, "a (4, 4) matrix that is no rigid transform",
                          "R^T R = I within 1e-6, det R = 1 and last row 0 0 0 1");
  }
  return {T.topLeftCorner<3, 3>(), T.topRightCorner<3, 1>()};
}

void write_pose(const SE3& T, double* row_major) {
  for (int row = 0; row < 3; ++row) {
    double* to = row_major + 4 * row;
    to[0] = T.rotation(row, 0);
    to[1] = T.rotation(row, 1);
    to[2] = T.rotation(row, 2);
    to[3] = T.translation[row];
  }
  row_major[12] = row_major[13] = row_major[14] = 0.0;
  row_major[15] = 1.0;
}

}  // namespace thing_kin::python
