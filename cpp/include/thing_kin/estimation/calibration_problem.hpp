#pragma once

#include "thing_kin/estimation/calibration.hpp"

namespace thing_kin {

/// Measurements of an arm, and what is to be estimated of it.
class CalibrationProblem {
 public:
  /// Throws InvalidArgument if there is no parameter.
  CalibrationProblem(Chain chain, CalibrationData data,
                     std::vector<CalibrationParameter> parameters);

  const Chain& chain() const { return chain_; }
  const CalibrationData& data() const { return data_; }
  const std::vector<CalibrationParameter>& parameters() const { return parameters_; }
  std::vector<int> all_postures() const;

  /// What the parameters are on the data sheet: numbers of a row, points as given, 1 for scales; 0
  /// for what is a difference from it.
  Eigen::VectorXd nominal() const;

  /// By these postures alone.
  CalibrationFit fit(const CalibrationOptions& options, std::span<const int> postures) const;

  /// What these postures leave at a state, m and rad.
  Eigen::VectorXd errors(const CalibrationState& state, std::span<const int> postures) const;

  /// The chain as fitted: see CalibrationModel::calibrated().
  Chain calibrated(const CalibrationState& state) const;

  /// Whether measurements of the same kind at other postures, (dof, N), would tell each parameter;
  /// `torques` may be empty.
  std::vector<bool> told_at(const CalibrationFit& fit, const Eigen::MatrixXd& q,
                            const Eigen::MatrixXd& torques) const;

  /// The `count` postures that would tell most, beyond what the fit knows; see
  /// calibration_analysis.hpp.
  std::vector<int> most_telling_of(const CalibrationFit& fit, const Eigen::MatrixXd& candidates,
                                   const Eigen::MatrixXd& torques, int count) const;

 private:
  CalibrationData imagined(const CalibrationFit& fit, const Eigen::MatrixXd& q,
                           const Eigen::MatrixXd& torques) const;
  RowMajorMatrix derivatives(const CalibrationFit& fit, const CalibrationData& data) const;

  Chain chain_;
  CalibrationData data_;
  std::vector<CalibrationParameter> parameters_;
};

}  // namespace thing_kin
