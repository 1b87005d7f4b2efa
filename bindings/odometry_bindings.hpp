#pragma once

// One function a concept; odometry_module.cpp calls them.

#include <pybind11/pybind11.h>

namespace thing_kin::python {

namespace py = pybind11;

void bind_scan(py::module_& m);
void bind_scan_matching(py::module_& m);
void bind_laser_odometry(py::module_& m);

}  // namespace thing_kin::python
