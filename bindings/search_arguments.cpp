#include "search_arguments.hpp"

#include "thing_kin/core/error.hpp"
#include "thing_kin/core/random.hpp"

namespace thing_kin::python {

std::uint64_t read_seed(const Randomness& rng) {
  if (py::isinstance<py::bool_>(rng)) {
    throw InvalidArgument("rng", std::string(py::repr(rng)),
                          "a whole number >= 0, a numpy Generator or None");
  }
  if (rng.is_none()) {
    return py::module_::import("secrets").attr("randbits")(64).cast<std::uint64_t>();
  }
  if (py::hasattr(rng, "integers")) {
    return rng.attr("integers")(std::int64_t{0}, INT64_MAX).cast<std::uint64_t>();
  }
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(rng.ptr()));
  if (!index) {
    PyErr_Clear();
  } else if (index >= py::int_(0)) {
    // A seed of any length, as numpy takes it: 64 bits at a time.
    std::uint64_t key = 0;
    py::object rest = index;
    const py::int_ word(UINT64_MAX);
    do {
      key = mix_keys(key, (rest & word).cast<std::uint64_t>());
      rest = rest >> py::int_(64);
    } while (rest > py::int_(0));
    return key;
  }
  throw InvalidArgument("rng", std::string(py::repr(rng)),
                        "a whole number >= 0, a numpy Generator or None");
}

Eigen::Vector2d read_point(py::handle argument, const char* name) {
  const Batch point = read(argument, name, {2}, false);
  return {point.data[0], point.data[1]};
}

SearchPoints read_points(py::handle argument, const char* name, py::ssize_t least) {
  const Batch points = read(argument, name, {2});
  if (points.single || points.count < least) {
    throw InvalidArgument(name, "shape " + shape_text(&points.count, points.single ? 0 : 1),
                          "shape (n, 2), n >= " + std::to_string(least));
  }
  SearchPoints out;
  for (py::ssize_t i = 0; i < points.count; ++i) {
    out.emplace_back(points.item(i)[0], points.item(i)[1]);
  }
  return out;
}

std::size_t read_count(py::handle argument, const char* name, std::size_t otherwise) {
  if (argument.is_none()) {
    return otherwise;
  }
  const py::object index = py::isinstance<py::bool_>(argument)
                               ? py::object()
                               : py::reinterpret_steal<py::object>(PyNumber_Index(argument.ptr()));
  PyErr_Clear();
  if (!index || index < py::int_(1) || index > py::int_(kMostSearchPoints)) {
    throw InvalidArgument(name, std::string(py::repr(argument)),
                          "a whole number from 1 to 1000000");
  }
  return index.cast<std::size_t>();
}

Array points_array(const SearchPoints& points) {
  const py::ssize_t shape[] = {static_cast<py::ssize_t>(points.size()), 2};
  Array array = make_array(shape, 2);
  double* to = array.mutable_data();
  for (const Eigen::Vector2d& point : points) {
    *to++ = point.x();
    *to++ = point.y();
  }
  return array;
}

}  // namespace thing_kin::python
