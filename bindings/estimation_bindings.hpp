#pragma once

// One function a concept; estimation_module.cpp calls them layer by layer.

#include <pybind11/pybind11.h>

namespace thing_kin::python {

namespace py = pybind11;

void bind_planar_motion(py::module_& m);
void bind_encoder(py::module_& m);
void bind_mecanum(py::module_& m);
void bind_differential_drive(py::module_& m);
void bind_identify_mecanum(py::module_& m);

void bind_end_effector(py::module_& m);
void bind_base_localizer(py::module_& m);
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
