#include "map.hpp"

#include <algorithm>
#include <array>
#include <functional>

#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

// The C API, because a cast would throw for what does not fit.
bool is_positive_index(PyObject* value, int& result) {
  if (PyIndex_Check(value) == 0 || PyBool_Check(value)) {
    return false;
  }
  const py::ssize_t number = PyNumber_AsSsize_t(value, nullptr);  // clips what is too large
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    return false;
  }
  constexpr py::ssize_t kMost = 1024;
  result = static_cast<int>(std::min(number, kMost));
  return number >= 1;
}

bool overlap(const Batch& batch, const Array& out) {
  const double* first = out.data();
  const std::less<> before;
  return before(batch.data, first + out.size()) &&
         before(first, batch.data + batch.count * batch.size);
}

std::string shape_text(const py::ssize_t* shape, int dimensions) {
  std::string text(1, '(');
  for (int i = 0; i < dimensions; ++i) {
    text.append(std::to_string(shape[i])).append(i + 1 < dimensions ? ", " : "");
  }
  return text.append(dimensions == 1 ? ",)" : ")");
}

std::string description_of(const py::handle& out) {
  if (!py::isinstance<py::array>(out)) {
    return py::str(py::type::of(out).attr("__name__"));
  }
  const auto array = py::reinterpret_borrow<py::array>(out);
  std::string text = py::str(array.dtype());
  text.append(" of shape ").append(shape_text(array.shape(), static_cast<int>(array.ndim())));
  if (!array.writeable()) {
    return text.append(", read-only");
  }
  const bool ordered = (array.flags() & py::array::c_style) == py::array::c_style;
  return text.append(ordered ? "" : ", not in C order");
}

// The array to write to, if it can be written to as it is.
Array checked(const OutArray& out, const py::ssize_t* shape, int dimensions) {
  constexpr int kWritable = py::detail::npy_api::NPY_ARRAY_C_CONTIGUOUS_ |
                            py::detail::npy_api::NPY_ARRAY_ALIGNED_ |
                            py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  bool fits = py::isinstance<py::array>(out);
  if (fits) {
    const auto array = py::reinterpret_borrow<py::array>(out);
    fits = array.dtype().equal(py::dtype::of<double>()) &&
           (array.flags() & kWritable) == kWritable && array.ndim() == dimensions &&
           std::equal(shape, shape + dimensions, array.shape());
  }
  if (!fits) {
    throw InvalidArgument("out", description_of(out),
                          std::string("a writeable float64 array of shape ")
                              .append(shape_text(shape, dimensions))
                              .append(" in C order"));
  }
  return py::reinterpret_borrow<Array>(out);
}

}  // namespace

int read_threads(const ThreadCount& threads) {
  int count = 0;
  if (!threads.is_none() && !is_positive_index(threads.ptr(), count)) {
    throw InvalidArgument("threads", py::repr(threads), "None or a whole number from 1");
  }
  return count;
}

Array make_output(const Batch& batch, std::initializer_list<py::ssize_t> item,
                  const OutArray& out) {
  if (out.is_none()) {
    return make_array(batch, item);
  }
  std::array<py::ssize_t, 5> shape{batch.count};
  int dimensions = batch.single ? 0 : 1;
  for (const py::ssize_t length : item) {
    shape[static_cast<std::size_t>(dimensions++)] = length;
  }
  return checked(out, shape.data(), dimensions);
}

void detach(Batch& batch, const Array& out) {
  if (overlap(batch, out)) {
    const Array copy(batch.count * batch.size, batch.data);
    batch.data = copy.data();
    batch.owner = copy;
  }
}

}  // namespace thing_kin::python
