#include "map.hpp"

#include <algorithm>
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

bool overlap(const double* numbers, py::ssize_t size, const Array& out) {
  const double* first = out.data();
  const std::less<> before;
  return before(numbers, first + out.size()) && before(first, numbers + size);
}

std::string description_of(const py::handle& out) {
  if (!py::isinstance<py::array>(out)) {
    return py::str(py::type::of(out).attr("__name__"));
  }
  const auto array = py::reinterpret_borrow<py::array>(out);
  std::string text = py::str(array.dtype());
  text.append(" of shape ").append(shape_text(array.shape(), array.ndim()));
  if (!array.writeable()) {
    return text.append(", read-only");
  }
  const bool ordered = (array.flags() & py::array::c_style) == py::array::c_style;
  return text.append(ordered ? "" : ", not in C order");
}

// The array to write to, if it can be written to as it is.
Array checked(const OutArray& out, const Shape& shape) {
  const py::ssize_t* const lengths = shape.lengths.data();
  constexpr int kWritable = py::detail::npy_api::NPY_ARRAY_C_CONTIGUOUS_ |
                            py::detail::npy_api::NPY_ARRAY_ALIGNED_ |
                            py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  bool fits = py::isinstance<py::array>(out);
  if (fits) {
    const auto array = py::reinterpret_borrow<py::array>(out);
    fits = array.dtype().equal(py::dtype::of<double>()) &&
           (array.flags() & kWritable) == kWritable && array.ndim() == shape.dimensions &&
           std::equal(lengths, lengths + shape.dimensions, array.shape());
  }
  if (!fits) {
    throw InvalidArgument("out", description_of(out),
                          std::string("a writeable float64 array of shape ")
                              .append(shape_text(lengths, shape.dimensions))
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
  return out.is_none() ? make_array(batch, item) : checked(out, shape_of(batch, item));
}

void detach(Batch& batch, const Array& out) {
  if (overlap(batch.data, batch.count * batch.size, out)) {
    const Array copy(batch.count * batch.size, batch.data);
    batch.data = copy.data();
    batch.owner = copy;
  }
}

void check_apart(const Array& first, const Array& second) {
  if (overlap(first.data(), first.size(), second)) {
    throw InvalidArgument("out", "two arrays that share memory", "arrays of their own memory");
  }
}

}  // namespace thing_kin::python
