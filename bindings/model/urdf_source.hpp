#pragma once

#include <pybind11/pybind11.h>

namespace thing_kin::python {

namespace py = pybind11;

/// A path, XML text or bytes; what it is, is found out where it is read.
class UrdfSource : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(UrdfSource, object, [](PyObject*) { return 1; })
};

/// A mapping from names to paths, or None.
class Packages : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(Packages, object, [](PyObject*) { return 1; })
};

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::UrdfSource> {
  static constexpr auto name = const_name("str | bytes | os.PathLike[str]");
};

template <>
struct handle_type_name<thing_kin::python::Packages> {
  static constexpr auto name =
      const_name("collections.abc.Mapping[str, str | os.PathLike[str]] | None");
};

}  // namespace pybind11::detail
