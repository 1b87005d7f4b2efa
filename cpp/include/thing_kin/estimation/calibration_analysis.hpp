#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "thing_kin/estimation/calibration_residuals.hpp"

namespace thing_kin {

/// What a set of postures tells about the parameters, at first order.
struct CalibrationSight {
  int rank = 0;                     ///< combinations of parameters that are told
  Eigen::VectorXd singular_values;  ///< of the derivatives, each parameter in its deviations
  Eigen::MatrixXd covariance;       ///< of the parameters, deviations before included
  std::vector<bool> is_told;        ///< of each parameter: it is in no combination that is not
  /// Columns: motions of the parameters (m, rad) that change nothing, each with a one, or a
  /// minus one, at a parameter of its own; the first is positive.
  Eigen::MatrixXd unseen;
};

/// `J`: residuals in standard deviations by parameters; `inflation`: of the variance, by the loss.
/// A combination is told where the data halve its deviation before, at least.
CalibrationSight calibration_sight(const RowMajorMatrix& J,
                                   std::span<const CalibrationParameter> parameters,
                                   double inflation = 1.0);

/// "base.rz +1, joint_offsets[0] -1": a line for each column of `unseen`.
std::vector<std::string> unseen_in_words(const CalibrationSight& sight,
                                         std::span<const CalibrationParameter> parameters);

/// The `count` of the candidates' blocks of rows that shrink the covariance's determinant most,
/// chosen one after the other; each candidate has `rows` rows of J, those of one measured posture.
std::vector<int> most_telling(const RowMajorMatrix& J, int rows,
                              std::span<const CalibrationParameter> parameters,
                              const Eigen::MatrixXd& covariance, int count);

}  // namespace thing_kin
