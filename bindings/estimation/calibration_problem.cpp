#include "thing_kin/estimation/calibration_problem.hpp"

#include <utility>

#include <pybind11/stl.h>

#include "calibration_arguments.hpp"
#include "calibration_bindings.hpp"

namespace thing_kin::python {

void bind_calibration_problem(py::module_& m) {
  py::class_<CalibrationProblem>(m, "Problem",
                                 "Measurements of an arm, and what is to be estimated of it.")
      .def(py::init([](const Chain& chain, const py::object& q, const std::string& kind,
                       const py::object& measured, const py::object& points,
                       const py::object& covariance, const py::object& q_covariance,
                       const py::object& torques, std::vector<std::string> parameters,
                       std::map<std::string, double> priors, std::vector<int> sagging) {
             CalibrationData data = read_calibration_data(
                 chain, {q, measured, points, covariance, q_covariance, torques, kind});
             const int places = data.kind == CalibrationKind::kPoints ? data.per_posture() : 0;
             return CalibrationProblem(
                 chain, std::move(data),
                 calibration_parameters(chain, {std::move(parameters), std::move(priors), places,
                                                std::move(sagging)}));
           }),
           py::arg("chain"), py::arg("q"), py::arg("kind"), py::arg("measured"), py::arg("points"),
           py::arg("covariance"), py::arg("q_covariance"), py::arg("torques"),
           py::arg("parameters"), py::arg("priors"), py::arg("sagging"))
      .def_property_readonly("names",
                             [](const CalibrationProblem& p) {
                               std::vector<std::string> names;
                               for (const auto& parameter : p.parameters()) {
                                 names.push_back(parameter.name);
                               }
                               return names;
                             })
      .def_property_readonly("nominal",
                             [](const CalibrationProblem& p) { return to_array(p.nominal()); })
      .def_property_readonly("has_prior",
                             [](const CalibrationProblem& p) {
                               std::vector<bool> has;
                               for (const auto& parameter : p.parameters()) {
                                 has.push_back(parameter.has_prior);
                               }
                               return has;
                             })
      .def_property_readonly("rows", [](const CalibrationProblem& p) { return p.data().rows(); })
      .def_property_readonly("per_posture",
                             [](const CalibrationProblem& p) { return p.data().per_posture(); })
      .def(
          "nominal_errors",
          [](const CalibrationProblem& p, const py::object& base, const py::object& tool) {
            const auto n = static_cast<Eigen::Index>(p.parameters().size());
            return to_array(p.errors({read_one_pose(base, "base"), read_one_pose(tool, "tool"),
                                      Eigen::VectorXd::Zero(n)},
                                     p.all_postures()));
          },
          py::arg("base"), py::arg("tool"))
      .def(
          "fit",
          [](const CalibrationProblem& p, const std::string& loss,
             const std::optional<double>& loss_scale, double gate, int max_iterations,
             const py::object& base, const py::object& tool, const std::vector<int>& postures) {
            const CalibrationOptions options =
                read_calibration_options(loss, loss_scale, gate, max_iterations, base, tool);
            const py::gil_scoped_release release;
            return p.fit(options, postures);
          },
          py::arg("loss"), py::arg("loss_scale"), py::arg("gate"), py::arg("max_iterations"),
          py::arg("base"), py::arg("tool"), py::arg("postures"))
      .def(
          "errors",
          [](const CalibrationProblem& p, const CalibrationFit& fit,
             const std::vector<int>& postures) { return to_array(p.errors(fit.state, postures)); },
          py::arg("fit"), py::arg("postures"))
      .def(
          "chain",
          [](const CalibrationProblem& p, const CalibrationFit& fit) {
            return p.calibrated(fit.state);
          },
          py::arg("fit"))
      .def(
          "told_at",
          [](const CalibrationProblem& p, const CalibrationFit& fit, const py::object& q,
             const py::object& torques) {
            const int dof = p.chain().dof();
            return p.told_at(fit, read_postures(q, "q", dof),
                             read_postures(torques, "torques", dof));
          },
          py::arg("fit"), py::arg("q"), py::arg("torques"))
      .def(
          "most_telling",
          [](const CalibrationProblem& p, const CalibrationFit& fit, const py::object& q,
             const py::object& torques, int count) {
            const int dof = p.chain().dof();
            return p.most_telling_of(fit, read_postures(q, "candidates", dof),
                                     read_postures(torques, "torques", dof), count);
          },
          py::arg("fit"), py::arg("q"), py::arg("torques"), py::arg("count"))
      .def(
          "unseen_in_words",
          [](const CalibrationProblem& p, const CalibrationFit& fit) {
            return unseen_in_words(fit.sight, p.parameters());
          },
          py::arg("fit"));
}

}  // namespace thing_kin::python
