#pragma once

#include "thing_kin/estimation/calibration_residuals.hpp"

namespace thing_kin {

/// Residuals at the optimum, in deviations, and what the parameters take of each number.
struct CalibrationLeftover {
  Eigen::VectorXd r;
  Eigen::VectorXd shares;  ///< diagonal of the hat matrix
  int m = 6;               ///< numbers of a measurement

  /// Degrees of freedom.
  double dof() const { return static_cast<double>(r.size()) - shares.sum(); }
  /// Of a measurement's residual.
  double square(int block) const { return r.segment(block * m, m).squaredNorm(); }
};

/// How outliers are kept out of the noise.
enum class NoiseBy : std::uint8_t {
  kAll,     ///< not at all
  kMedian,  ///< the median; no more than a guess
  kInliers  ///< what is within the 99 % gate, corrected for being cut there
};

/// Squares for each degree of freedom, of rows [first, first + count) of each measurement: 1 where
/// the noise is right.
double variance_factor(const CalibrationLeftover& leftover, Eigen::Index first, Eigen::Index count,
                       NoiseBy by);

/// From errors (m, rad) as the start leaves them: medians.
CalibrationNoise first_noise(const Eigen::VectorXd& errors, const CalibrationData& data);

/// The noise that the residuals have, where `before` was taken to be theirs.
CalibrationNoise fitted_noise(const CalibrationNoise& before, const CalibrationLeftover& leftover,
                              const CalibrationData& data, NoiseBy by);

}  // namespace thing_kin
