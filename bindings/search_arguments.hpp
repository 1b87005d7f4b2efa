#pragma once

// What bindings of searches have in common.

#include <cstdint>

#include "array.hpp"
#include "thing_kin/search/spiral.hpp"

namespace thing_kin::python {

/// An argument `rng`: a seed, a numpy Generator, which is then asked for one, or None for any.
class Randomness : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(Randomness, object, [](PyObject*) { return 1; })
};

std::uint64_t read_seed(const Randomness& rng);

/// (2,) finite numbers.
Eigen::Vector2d read_point(py::handle argument, const char* name);
/// (n, 2) finite numbers, `least` or more.
SearchPoints read_points(py::handle argument, const char* name, py::ssize_t least);
/// A whole number of things from `least`; None gives `otherwise`.
std::size_t read_count(py::handle argument, const char* name, std::size_t otherwise);

/// (n, 2)
Array points_array(const SearchPoints& points);

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::Randomness> {
  static constexpr auto name = const_name("int | numpy.random.Generator | None");
};

}  // namespace pybind11::detail
