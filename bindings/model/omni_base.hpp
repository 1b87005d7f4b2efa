#pragma once

#include <pybind11/pybind11.h>

#include "thing_kin/model/omni_base.hpp"

namespace thing_kin::python {

/// `limits` with the positions of x, y and theta replaced by three pairs, unless None.
BaseLimits with_ranges(BaseLimits limits, const pybind11::object& ranges);

}  // namespace thing_kin::python
