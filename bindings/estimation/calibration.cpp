#include "thing_kin/estimation/calibration.hpp"

#include <pybind11/stl.h>

#include "array.hpp"
#include "calibration_bindings.hpp"

namespace thing_kin::python {

namespace {

const char* status_of(CalibrationStatus status) {
  switch (status) {
    case CalibrationStatus::kConverged:
      return "converged";
    case CalibrationStatus::kNotConverged:
      return "not converged";
    case CalibrationStatus::kUnderdetermined:
      break;
  }
  return "underdetermined";
}

}  // namespace

void bind_calibration(py::module_& m) {
  const auto places = [](const CalibrationFit& fit, auto member) {
    std::vector<int> all;
    all.reserve(fit.blocks.size());
    for (const auto& block : fit.blocks) {
      all.push_back(block.*member);
    }
    return all;
  };
  py::class_<CalibrationFit>(m, "Fit", "Of a Problem.")
      .def_property_readonly("status", [](const CalibrationFit& f) { return status_of(f.status); })
      .def_property_readonly("base",
                             [](const CalibrationFit& f) { return pose_to_array(f.state.base); })
      .def_property_readonly("tool",
                             [](const CalibrationFit& f) { return pose_to_array(f.state.tool); })
      .def_property_readonly("values", [](const CalibrationFit& f) { return to_array(f.values); })
      .def_property_readonly("noise",
                             [](const CalibrationFit& f) {
                               return py::make_tuple(f.noise.position, f.noise.rotation);
                             })
      .def_readonly("noise_is_estimated", &CalibrationFit::noise_is_estimated)
      .def_readonly("variance_factor", &CalibrationFit::variance_factor)
      .def_readonly("dof", &CalibrationFit::dof)
      .def_readonly("iterations", &CalibrationFit::iterations)
      .def_property_readonly("postures",
                             [places](const CalibrationFit& f) {
                               return places(f, &CalibrationResiduals::Block::posture);
                             })
      .def_property_readonly("points",
                             [places](const CalibrationFit& f) {
                               return places(f, &CalibrationResiduals::Block::point);
                             })
      .def_property_readonly("errors", [](const CalibrationFit& f) { return to_array(f.errors); })
      .def_property_readonly("distances",
                             [](const CalibrationFit& f) { return to_array(f.distances); })
      .def_readonly("outliers", &CalibrationFit::outliers)
      .def_property_readonly("rank", [](const CalibrationFit& f) { return f.sight.rank; })
      .def_property_readonly("covariance",
                             [](const CalibrationFit& f) { return to_array(f.sight.covariance); })
      .def_property_readonly("is_told", [](const CalibrationFit& f) { return f.sight.is_told; });
}

}  // namespace thing_kin::python
