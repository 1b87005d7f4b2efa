#pragma once

#include <pybind11/pybind11.h>

namespace thing_kin::python {

/// The part of the module _kdl that solves inverse kinematics.
void bind_kdl_ik(pybind11::module_& m);

}  // namespace thing_kin::python
