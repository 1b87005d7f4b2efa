#include "thing_kin/estimation/calibration_noise.hpp"

#include <algorithm>
#include <cmath>

#include "thing_kin/core/chi_square.hpp"

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kLeastNoise = 1e-7;  // m, rad: nothing is measured better

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double factor_by_median(const CalibrationLeftover& leftover, Index first, Index count) {
  std::vector<double> squares;
  double taken = 0.0;
  for (Index row = 0; row < leftover.r.size(); row += leftover.m) {
    squares.push_back(leftover.r.segment(row + first, count).squaredNorm());
    taken += leftover.shares.segment(row + first, count).sum();
  }
  const double rows = static_cast<double>(squares.size()) * static_cast<double>(count);
  return median_of(squares) / chi_square_quantile(0.5, static_cast<int>(count)) * rows /
         std::max(rows - taken, 1e-300);
}

}  // namespace

double variance_factor(const CalibrationLeftover& leftover, Index first, Index count, NoiseBy by) {
  if (by == NoiseBy::kMedian) {
    return factor_by_median(leftover, first, count);
  }
  const int m = leftover.m;
  const double gate = chi_square_quantile(0.99, m);
  double sum = 0.0;
  double freedom = 0.0;
  for (int block = 0; block * m < leftover.r.size(); ++block) {
    if (by == NoiseBy::kAll || leftover.square(block) < gate) {
      const Index row = static_cast<Index>(block) * m + first;
      sum += leftover.r.segment(row, count).squaredNorm();
      freedom += static_cast<double>(count) - leftover.shares.segment(row, count).sum();
    }
  }
  // The mean square of what is not cut off.
  const double cut = by == NoiseBy::kInliers ? chi_square_probability(gate, m + 2) / 0.99 : 1.0;
  return freedom > 0.5 ? sum / (freedom * cut) : 1.0;
}

CalibrationNoise first_noise(const VectorXd& errors, const CalibrationData& data) {
  const Index m = data.rows();
  const auto typical = [&](Index first, Index count) {
    std::vector<double> squares;
    for (Index row = 0; row < errors.size(); row += m) {
      squares.push_back(errors.segment(row + first, count).squaredNorm() /
                        static_cast<double>(count));
    }
    return squares.empty() ? 1e-3 : std::max(std::sqrt(median_of(squares)), 1e-5);
  };
  CalibrationNoise noise;
  const Index k = data.position_rows();
  noise.position = typical(0, k);
  noise.rotation = m > k ? typical(k, m - k) : noise.rotation;
  return noise;
}

CalibrationNoise fitted_noise(const CalibrationNoise& before, const CalibrationLeftover& leftover,
                              const CalibrationData& data, NoiseBy by) {
  const auto fitted = [&](double noise, Index first, Index count) {
    return std::max(noise * std::sqrt(variance_factor(leftover, first, count, by)), kLeastNoise);
  };
  const Index k = data.position_rows();
  const Index m = data.rows();
  return {fitted(before.position, 0, k),
          m > k ? fitted(before.rotation, k, m - k) : before.rotation};
}

}  // namespace thing_kin
