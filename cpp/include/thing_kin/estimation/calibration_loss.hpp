#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace thing_kin {

/// What a measurement counts, by its distance in standard deviations.
enum class CalibrationLoss : std::uint8_t { kLinear, kHuber, kSoftL1, kCauchy, kTukey };

/// "linear", "huber", "soft_l1", "cauchy", "tukey"; throws InvalidArgument.
CalibrationLoss calibration_loss_from_string(const std::string& name);

/// Where the loss leaves the parabola, for residuals of `m` numbers: as efficient as 95 % with
/// normal noise.
double standard_loss_scale(CalibrationLoss loss, int m);

/// rho and its first two derivatives by `square`, the residual's squared length; Triggs et al.
/// 2000. rho is `square` where that is small.
std::array<double, 3> loss_at(CalibrationLoss loss, double scale, double square);

}  // namespace thing_kin
