#pragma once

// What calibration_module.cpp calls.

#include "array.hpp"
#include "thing_kin/lie/se3.hpp"

namespace thing_kin::python {

Array pose_to_array(const SE3& T);

void bind_calibration(py::module_& m);
void bind_calibration_problem(py::module_& m);

}  // namespace thing_kin::python
