#pragma once

#include <span>

#include "thing_kin/estimation/calibration_residuals.hpp"

namespace thing_kin {

/// What the parameters take of the residuals: the hat matrix H = J (J^T J + before)^-1 J^T.
class CalibrationLeverage {
 public:
  CalibrationLeverage() = default;
  /// `J`: residuals in standard deviations by parameters.
  CalibrationLeverage(const RowMajorMatrix& J, std::span<const CalibrationParameter> parameters);

  /// The diagonal of H.
  Eigen::VectorXd shares() const;

  /// Squared distance of the residuals from `row` on, in deviations of their own, whose covariance
  /// is I - H there; along what the parameters take whole they tell nothing.
  double square_of_rest(Eigen::Index row, const Eigen::VectorXd& r) const;

 private:
  Eigen::MatrixXd root_;  // H = root^T root
};

}  // namespace thing_kin
