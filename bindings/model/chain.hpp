#pragma once

#include <pybind11/pybind11.h>

#include "thing_kin/model/chain.hpp"

namespace thing_kin::python {

/// A frame argument: a name, an index or None for the chain's last.
int read_frame(const Chain& chain, const pybind11::object& frame, const char* name);

/// n numbers, infinities allowed.
SmallVector read_limits(const pybind11::object& values, const char* name, int n);

/// n positive numbers, infinities allowed.
SmallVector read_rates(const pybind11::object& values, const char* name, int n);

}  // namespace thing_kin::python
