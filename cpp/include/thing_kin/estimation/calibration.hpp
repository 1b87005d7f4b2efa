#pragma once

#include <limits>

#include "thing_kin/estimation/calibration_analysis.hpp"
#include "thing_kin/estimation/calibration_loss.hpp"

namespace thing_kin {

struct CalibrationOptions {
  CalibrationLoss loss = CalibrationLoss::kCauchy;
  /// Where the loss leaves the parabola, in standard deviations; NaN: standard_loss_scale().
  double loss_scale = std::numeric_limits<double>::quiet_NaN();
  double gate = 0.999;  ///< a measurement beyond this quantile of chi-square is an outlier
  int max_iterations = 100;
  SE3 base, tool;  ///< nominal
};

enum class CalibrationStatus : std::uint8_t {
  kConverged,
  kNotConverged,    ///< max_iterations
  kUnderdetermined  ///< the data have no more rows than what they tell about the parameters
};

/// The arm that is there, as far as the data tell.
struct CalibrationFit {
  CalibrationStatus status = CalibrationStatus::kNotConverged;
  CalibrationState state;  ///< recentered
  Eigen::VectorXd values;  ///< of the parameters, base and tool as motions E from nominal
  CalibrationNoise noise;
  bool noise_is_estimated = false;
  double variance_factor = 1.0;  ///< squared residuals for each degree of freedom, outliers apart
  double dof = 0.0;              ///< rows less what the parameters take of them
  int iterations = 0;
  std::vector<CalibrationResiduals::Block> blocks;
  Eigen::VectorXd errors;      ///< m and rad, rows of each block
  Eigen::VectorXd distances;   ///< of each block, in deviations of its residual
  std::vector<bool> outliers;  ///< of each block
  CalibrationSight sight;
};

/// Least squares under the loss, each parameter's deviation before as weak knowledge, by Ceres;
/// noise, where no covariance is given, from what is left. Throws nothing.
CalibrationFit fit_calibration(CalibrationModel& model, const CalibrationData& data,
                               std::span<const int> postures, const CalibrationOptions& options);

}  // namespace thing_kin
