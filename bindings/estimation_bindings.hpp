#pragma once

// One function a concept; estimation_module.cpp calls them in the order of the layers.

#include <pybind11/pybind11.h>

namespace thing_kin::python {

namespace py = pybind11;

void bind_chi_square(py::module_& m);
void bind_gaussian_filter(py::module_& m);
void bind_motion_models(py::module_& models, py::module_& m);
void bind_measurement_models(py::module_& models, py::module_& m);
void bind_filter_run(py::module_& m);
void bind_kalman(py::module_& m);
void bind_extended_kalman(py::module_& m);
void bind_unscented_kalman(py::module_& m);
void bind_numeric_jacobian(py::module_& m);
void bind_consistency(py::module_& m);

}  // namespace thing_kin::python
