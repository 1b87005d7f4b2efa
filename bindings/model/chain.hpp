#pragma once

#include <pybind11/pybind11.h>

#include "thing_kin/model/chain.hpp"

namespace thing_kin::python {

/// A frame argument: a name, an index or None for the chain's last.
class FrameLike : public pybind11::object {
 public:
  PYBIND11_OBJECT_DEFAULT(FrameLike, object, [](PyObject*) { return 1; })
};

int read_frame(const Chain& chain, const pybind11::object& frame, const char* name);

/// Throws InvalidArgument for a robot that stands on none.
void check_omni_base(const Chain& chain);

/// n numbers, infinities allowed.
SmallVector read_limits(const pybind11::object& values, const char* name, int n);

/// n positive numbers, infinities allowed.
SmallVector read_rates(const pybind11::object& values, const char* name, int n);

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::FrameLike> {
  static constexpr auto name = const_name("str | int | None");
};

}  // namespace pybind11::detail
