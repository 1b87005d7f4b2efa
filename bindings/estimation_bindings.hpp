#pragma once

// One function a concept; estimation_module.cpp calls them in the order of the layers.

#include <pybind11/pybind11.h>

namespace thing_kin::python {

namespace py = pybind11;

void bind_base_localizer(py::module_& m);

}  // namespace thing_kin::python
