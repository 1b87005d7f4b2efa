#include <pybind11/pybind11.h>

#include "estimation_bindings.hpp"

PYBIND11_MODULE(_estimation, m) {
  using namespace thing_kin::python;
  py::module_::import("thing_kin._core");  // brings the types of the model
  m.doc() = "Odometry and estimation. Private: import its names from thing_kin.estimation.";

  bind_chi_square(m);
  bind_planar_motion(m);
  bind_encoder(m);
  bind_mecanum(m);
  bind_differential_drive(m);
  bind_identify_mecanum(m);

  py::module_ models = m.def_submodule("models", "Built-in models, which run in the core.");
  bind_motion_models(models, m);
  bind_measurement_models(models, m);
  bind_gaussian_filter(m);
  bind_filter_run(m);
  bind_kalman(m);
  bind_extended_kalman(m);
  bind_unscented_kalman(m);
  bind_numeric_jacobian(m);
  bind_consistency(m);
  bind_end_effector(m);
  bind_base_localizer(m);
}
