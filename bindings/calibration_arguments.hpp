#pragma once

// What Python gives to a calibration, checked.

#include <optional>
#include <string>
#include <vector>

#include "array.hpp"
#include "thing_kin/estimation/calibration_problem.hpp"

namespace thing_kin::python {

struct CalibrationArguments {
  py::object q, measured, points, covariance, q_covariance, torques;
  std::string kind;
};

CalibrationData read_calibration_data(const Chain& chain, const CalibrationArguments& arguments);

/// The identity for None.
SE3 read_one_pose(const py::object& argument, const char* name);

/// (N, dof) as columns; empty for None.
Eigen::MatrixXd read_postures(const py::object& argument, const char* name, int dof);

/// Numbers of one shape, or many of it if `several`; `is_covariance`: each checked to be one.
Array read_numbers(const py::object& argument, const std::string& name,
                   const std::vector<py::ssize_t>& item, bool several, bool is_covariance);

CalibrationOptions read_calibration_options(const std::string& loss,
                                            const std::optional<double>& loss_scale, double gate,
                                            int max_iterations, const py::object& base,
                                            const py::object& tool);

}  // namespace thing_kin::python
