#pragma once

#include <pybind11/pybind11.h>

#include "thing_kin/odometry/mecanum.hpp"

namespace thing_kin::python {

/// ('fl', 'rl', 'rr', 'fr') in any order; throws InvalidArgument naming `order`.
WheelOrder read_order(const pybind11::object& order);

/// The order of [M17] (3.20).
pybind11::tuple default_order();

}  // namespace thing_kin::python
