#pragma once

#include "array.hpp"
#include "thing_kin/model/chain.hpp"

namespace thing_kin::python {

/// An argument `jacobian`: 'whole_body', 'arm' or a weight for each joint.
class JacobianColumns : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(JacobianColumns, object, [](PyObject*) { return 1; })
};

/// Factors of the Jacobian's columns; empty for the whole body.
JointVector read_column_weights(const JacobianColumns& argument, const Chain& chain);

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::JacobianColumns> {
  static constexpr auto name = const_name("str | numpy.typing.ArrayLike");
};

}  // namespace pybind11::detail
