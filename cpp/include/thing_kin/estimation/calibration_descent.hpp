#pragma once

#include "thing_kin/estimation/calibration_loss.hpp"
#include "thing_kin/estimation/calibration_residuals.hpp"

namespace thing_kin {

struct CalibrationDescentOptions {
  CalibrationLoss loss = CalibrationLoss::kLinear;
  double loss_scale = 1.0;
  double tolerance = 1e-9;  ///< of the cost, relatively, in the last step
  int max_iterations = 100;
};

/// Where a descent ended.
struct CalibrationDescent {
  CalibrationState state;
  bool converged = false;
  int iterations = 0;
  Eigen::VectorXd r;  ///< there, in standard deviations
  RowMajorMatrix J;
};

/// Least squares under a loss, each parameter's deviation before as weak knowledge, by Ceres.
CalibrationDescent descend_calibration(CalibrationResiduals& residuals,
                                       std::span<const CalibrationParameter> parameters,
                                       const CalibrationState& start,
                                       const CalibrationDescentOptions& options);

}  // namespace thing_kin
