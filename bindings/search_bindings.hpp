#pragma once

// One function a concept; search_module.cpp calls them.

#include <pybind11/pybind11.h>

namespace thing_kin::python {

namespace py = pybind11;

void bind_spiral(py::module_& m);
void bind_stochastic(py::module_& m);
void bind_compensation(py::module_& m);
void bind_covering(py::module_& m);
void bind_world(py::module_& m);
void bind_manipulator_arm(py::module_& m);
void bind_experiment(py::module_& m);

}  // namespace thing_kin::python
