#pragma once

#include <pybind11/pybind11.h>

#include "thing_kin/model/ur_calibration.hpp"

namespace thing_kin::python {

/// A path to the driver's YAML, or a mapping of the same shape.
class CalibrationSource : public pybind11::object {
 public:
  PYBIND11_OBJECT_DEFAULT(CalibrationSource, object, [](PyObject*) { return 1; })
};

UrCalibration read_calibration(const pybind11::object& source);

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::CalibrationSource> {
  static constexpr auto name =
      const_name("str | os.PathLike[str] | collections.abc.Mapping[str, typing.Any] | None");
};

}  // namespace pybind11::detail
