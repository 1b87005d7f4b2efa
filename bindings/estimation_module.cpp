#include <pybind11/pybind11.h>

#include "estimation_bindings.hpp"

PYBIND11_MODULE(_estimation, m) {
  using namespace thing_kin::python;
  py::module_::import("thing_kin._core");  // brings the types of the model
  m.doc() = "Odometry and estimation. Private: import its names from thing_kin.estimation.";

  bind_planar_motion(m);
  bind_encoder(m);
  bind_mecanum(m);
  bind_differential_drive(m);
  bind_identify_mecanum(m);

  bind_end_effector(m);
  bind_base_localizer(m);
}
