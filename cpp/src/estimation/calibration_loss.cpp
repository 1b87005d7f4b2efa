#include "thing_kin/estimation/calibration_loss.hpp"

#include <cmath>
#include <utility>

#include "thing_kin/core/chi_square.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin {

CalibrationLoss calibration_loss_from_string(const std::string& name) {
  constexpr std::array<std::pair<const char*, CalibrationLoss>, 5> kLosses{
      {{"linear", CalibrationLoss::kLinear},
       {"huber", CalibrationLoss::kHuber},
       {"soft_l1", CalibrationLoss::kSoftL1},
       {"cauchy", CalibrationLoss::kCauchy},
       {"tukey", CalibrationLoss::kTukey}}};
  for (const auto& [text, loss] : kLosses) {
    if (name == text) {
      return loss;
    }
  }
  throw InvalidArgument("loss", quoted(shortened(name, 40)),
                        "'linear', 'huber', 'soft_l1', 'cauchy' or 'tukey'");
}

// The usual constants for one number, as multiples of its 95 % quantile.
double standard_loss_scale(CalibrationLoss loss, int m) {
  const double bound = std::sqrt(chi_square_quantile(0.95, m)) / 1.96;
  switch (loss) {
    case CalibrationLoss::kHuber:
    case CalibrationLoss::kSoftL1:
      return 1.345 * bound;
    case CalibrationLoss::kCauchy:
      return 2.385 * bound;
    case CalibrationLoss::kTukey:
      return 4.685 * bound;
    case CalibrationLoss::kLinear:
      break;
  }
  return 1.0;
}

std::array<double, 3> loss_at(CalibrationLoss loss, double scale, double square) {
  const double bound = scale * scale;
  const double relative = square / bound;
  switch (loss) {
    case CalibrationLoss::kHuber:
      if (relative > 1.0) {
        const double slope = 1.0 / std::sqrt(relative);
        return {bound * (2.0 / slope - 1.0), slope, -0.5 * slope / square};
      }
      break;
    case CalibrationLoss::kSoftL1: {
      const double root = std::sqrt(1.0 + relative);
      return {2.0 * bound * (root - 1.0), 1.0 / root, -0.5 / (bound * root * root * root)};
    }
    case CalibrationLoss::kCauchy: {
      const double slope = 1.0 / (1.0 + relative);
      return {bound * std::log1p(relative), slope, -slope * slope / bound};
    }
    case CalibrationLoss::kTukey: {
      if (relative > 1.0) {
        return {bound / 3.0, 0.0, 0.0};
      }
      const double rest = 1.0 - relative;
      return {bound / 3.0 * (1.0 - rest * rest * rest), rest * rest, -2.0 * rest / bound};
    }
    case CalibrationLoss::kLinear:
      break;
  }
  return {square, 1.0, 0.0};
}

}  // namespace thing_kin
