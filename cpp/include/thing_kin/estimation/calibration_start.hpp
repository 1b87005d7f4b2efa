#pragma once

#include <span>

#include "thing_kin/estimation/calibration_residuals.hpp"

namespace thing_kin {

/// Base, tool and points to begin from, wherever they are: with M = R_base^T,
///
///     M place + u = R_last point + t_last
///
/// is linear in M, u and the points (of a pose: its origin and a point on each axis); solved by
/// least squares, reweighted for outliers, and M turned into a rotation. What is not estimated
/// stays. Better of that and `nominal`. Of hits: `nominal`.
CalibrationState calibration_start(CalibrationModel& model, const CalibrationData& data,
                                   std::span<const int> postures, const CalibrationState& nominal);

}  // namespace thing_kin
