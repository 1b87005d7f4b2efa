// How well wheels and reference agree over one motion and over several tells their noise apart: the
// reference's is the same for both, that of the wheels grows with the way.

#include <algorithm>
#include <cmath>
#include <vector>

#include "mecanum_fit.hpp"

namespace thing_kin {

namespace {

// The median of the square of a normal variable of variance one.
constexpr double kMedianSquare = 0.4549;
constexpr double kLeastSlip = 1e-8;  // m^2/m, rad^2/m: 0.1 mm and 0.1 mrad over a metre
// A window in which the rims move less than this tells nothing of slip, m.
constexpr double kRollingTravel = 0.01;

struct Spread {
  std::vector<double> squares;
  double weighted = 0.0;
  double weights = 0.0;
  double travel = 0.0;

  // Of many the weighted mean; the median until outliers are known.
  double variance(bool known) {
    return known && weights > 0.0 ? weighted / weights : median_of(squares) / kMedianSquare;
  }
  double mean_travel() const { return travel / static_cast<double>(squares.size()); }
};

// Of x, y, theta, over `lag` motions in a row.
std::array<Spread, 3> spread_over(const std::vector<RelativeMotion>& motions,
                                  const std::vector<WheelMotion>& rolled,
                                  const std::vector<double>& weights, std::size_t lag) {
  std::array<Spread, 3> spreads;
  for (std::size_t i = 0; i + lag <= motions.size(); ++i) {
    Eigen::Vector3d error = Eigen::Vector3d::Zero();
    double travel = 0.0;
    double weight = 1.0;
    bool whole = true;
    for (std::size_t k = i; k < i + lag; ++k) {
      error = se2_adjoint(inverse(rolled[k].pose)) * error + motions[k].error;
      travel += motions[k].travel;
      weight = std::min(weight, weights[k]);
      whole = whole && motions[k].whole && motions[k].travel > kRollingTravel;
    }
    for (std::size_t c = 0; whole && c < 3; ++c) {
      const double value = error[static_cast<Eigen::Index>(c)];
      spreads[c].squares.push_back(value * value);
      spreads[c].weighted += weight * value * value;
      spreads[c].weights += weight;
      spreads[c].travel += travel;
    }
  }
  return spreads;
}

}  // namespace

void MecanumFit::estimate_noise(bool outliers_known) {
  // As many in a row as leave a dozen that do not overlap: slip lasts longer than a window.
  const std::size_t lag = std::clamp<std::size_t>(motions_.size() / 12, 2, 8);
  std::array<Spread, 3> one = spread_over(motions_, rolled_, weights_, 1);
  std::array<Spread, 3> more = spread_over(motions_, rolled_, weights_, lag);
  constexpr std::size_t kEnough = 4;
  for (std::size_t c = 0; c < 3 && more[c].squares.size() >= kEnough; ++c) {
    const auto i = static_cast<Eigen::Index>(c);
    const double V1 = one[c].variance(outliers_known);
    const double V2 = more[c].variance(outliers_known);
    const double slope = (V2 - V1) / (more[c].mean_travel() - one[c].mean_travel());
    double slip = std::max(slope, kLeastSlip);
    const double reference = std::max(0.0, 0.5 * (V1 - slip * one[c].mean_travel()));
    std::vector<double> own;
    own.reserve(windows_.size());
    for (const ReferenceWindow& window : windows_) {
      own.push_back(window.variance[i]);
    }
    const double seen = median_of(own);
    noise.reference[i] = std::max(0.0, reference - seen);
    if (reference < seen) {
      slip = std::max(kLeastSlip, (V2 - 2.0 * seen) / more[c].mean_travel());
    }
    noise.slip[i] = slip;
  }
}

}  // namespace thing_kin
