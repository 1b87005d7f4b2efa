#include "thing_kin/estimation/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "thing_kin/core/chi_square.hpp"
#include "thing_kin/estimation/calibration_descent.hpp"
#include "thing_kin/estimation/calibration_leverage.hpp"
#include "thing_kin/estimation/calibration_noise.hpp"
#include "thing_kin/estimation/calibration_start.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kRoughly = 1e-4;   // of the cost: while the noise is sought
constexpr double kExactly = 1e-10;  // of the cost
constexpr double kSameNoise = 0.03;
constexpr double kLeastFreedom = 1.0;

class Fit {
 public:
  Fit(CalibrationModel& model, const CalibrationData& data, std::span<const int> postures,
      const CalibrationOptions& options)
      : model_(model), options_(options), residuals_(model, data, postures) {
    const CalibrationState nominal{options.base, options.tool, VectorXd::Zero(model.size())};
    fit_.state = calibration_start(model, data, postures, nominal);
    fit_.blocks.assign(residuals_.blocks().begin(), residuals_.blocks().end());
    leftover_.m = data.rows();
  }

  CalibrationFit run() {
    bool converged = true;
    if (!fit_.blocks.empty()) {
      if (data().covariances.empty()) {
        find_noise();
      }
      converged = solve(options_.loss, kExactly);
    }
    finish(converged);
    return std::move(fit_);
  }

 private:
  const CalibrationData& data() const { return residuals_.data(); }

  bool solve(CalibrationLoss loss, double tolerance) {
    residuals_.weigh(fit_.state, fit_.noise);
    const bool is_given = loss == options_.loss && !std::isnan(options_.loss_scale);
    const double scale = is_given ? options_.loss_scale : standard_loss_scale(loss, leftover_.m);
    CalibrationDescent descent =
        descend_calibration(residuals_, model_.parameters(), model_.recentered(fit_.state),
                            {loss, scale, tolerance, options_.max_iterations});
    fit_.iterations += descent.iterations;
    fit_.state = model_.recentered(descent.state);
    leftover_.r = std::move(descent.r);
    J_ = std::move(descent.J);
    return descent.converged;
  }

  // In turns: parameters by the noise, noise by what the parameters leave. Once roughly by
  // medians, under a loss that knows no second optimum.
  void find_noise() {
    constexpr int kRounds = 12;
    const bool is_robust = options_.loss != CalibrationLoss::kLinear;
    VectorXd e;
    residuals_.errors(fit_.state, e, nullptr);
    fit_.noise = first_noise(e, data());
    for (int round = 0; round < kRounds; ++round) {
      const bool is_rough = is_robust && round == 0;
      solve(is_rough ? CalibrationLoss::kHuber : options_.loss, kRoughly);
      leftover_.shares = CalibrationLeverage(J_, model_.parameters()).shares();
      fit_.noise_is_estimated = leftover_.dof() >= kLeastFreedom;
      if (!fit_.noise_is_estimated) {
        fit_.noise = CalibrationNoise{};
        if (round > 1) {
          return;
        }
        continue;
      }
      const CalibrationNoise before = fit_.noise;
      fit_.noise =
          fitted_noise(before, leftover_, data(), is_rough ? NoiseBy::kMedian : noise_by());
      const double change = std::max(std::abs(fit_.noise.position / before.position - 1.0),
                                     std::abs(fit_.noise.rotation / before.rotation - 1.0));
      if (round > 0 && change < kSameNoise) {
        return;
      }
    }
  }

  NoiseBy noise_by() const {
    return options_.loss == CalibrationLoss::kLinear ? NoiseBy::kAll : NoiseBy::kInliers;
  }

  // How much wider the loss makes the covariance than least squares would: Huber 1981, with the
  // divergence of w(|r|) r for a residual of several numbers.
  double inflation() const {
    if (options_.loss == CalibrationLoss::kLinear) {
      return 1.0;
    }
    const int m = leftover_.m;
    const double scale = std::isnan(options_.loss_scale) ? standard_loss_scale(options_.loss, m)
                                                         : options_.loss_scale;
    double squared = 0.0;
    double slope = 0.0;
    for (int block = 0; std::cmp_less(block, fit_.blocks.size()); ++block) {
      const double s = leftover_.square(block);
      const auto [rho, by_square, twice] = loss_at(options_.loss, scale, s);
      squared += by_square * by_square * s / m;
      slope += by_square + 2.0 * twice * s / m;
    }
    const auto n = static_cast<double>(fit_.blocks.size());
    const double freedom = std::max(n - leftover_.shares.sum() / m, 1.0);
    const double mean = slope / n;
    return mean > 0.05 ? std::clamp(squared / freedom / (mean * mean), 0.5, 100.0) : 100.0;
  }

  // A residual's own covariance is I - H; along what the parameters take whole it tells nothing.
  void judge(const CalibrationLeverage& leverage) {
    const int m = leftover_.m;
    const double bound = chi_square_quantile(options_.gate, m);
    fit_.distances.resize(static_cast<Index>(fit_.blocks.size()));
    fit_.outliers.assign(fit_.blocks.size(), false);
    for (std::size_t b = 0; b < fit_.blocks.size(); ++b) {
      const Index row = static_cast<Index>(b) * m;
      const double square = leverage.square_of_rest(row, leftover_.r.segment(row, m));
      fit_.distances[static_cast<Index>(b)] = std::sqrt(square);
      fit_.outliers[b] = square > bound;
    }
  }

  void finish(bool converged) {
    residuals_.weigh(fit_.state, fit_.noise);
    J_.resize(residuals_.rows(), residuals_.size());
    residuals_.evaluate(fit_.state, leftover_.r, &J_);
    const CalibrationLeverage leverage(J_, model_.parameters());
    leftover_.shares = leverage.shares();
    fit_.dof = leftover_.dof();
    fit_.sight = calibration_sight(J_, model_.parameters(), inflation());
    if (fit_.dof >= kLeastFreedom) {
      fit_.variance_factor = variance_factor(leftover_, 0, leftover_.m, noise_by());
    }
    judge(leverage);
    residuals_.errors(fit_.state, fit_.errors, nullptr);
    write_values();
    fit_.status = fit_.dof < kLeastFreedom ? CalibrationStatus::kUnderdetermined
                  : converged              ? CalibrationStatus::kConverged
                                           : CalibrationStatus::kNotConverged;
  }

  void write_values() {
    fit_.values = fit_.state.values;
    const SE3 base = options_.base.inverse() * fit_.state.base;
    const SE3 tool = fit_.state.tool * options_.tool.inverse();
    for (int i = 0; i < model_.size(); ++i) {
      const CalibrationParameter& parameter = model_.parameters()[static_cast<std::size_t>(i)];
      const bool is_base = parameter.part == CalibrationPart::kBase;
      if (is_base || parameter.part == CalibrationPart::kTool) {
        const SE3& E = is_base ? base : tool;
        fit_.values[i] = parameter.axis < 3 ? E.translation[parameter.axis]
                                            : so3_log(E.rotation)[parameter.axis - 3];
      }
    }
  }

  CalibrationModel& model_;
  const CalibrationOptions& options_;
  CalibrationResiduals residuals_;
  CalibrationFit fit_;
  CalibrationLeftover leftover_;
  RowMajorMatrix J_;
};

}  // namespace

CalibrationFit fit_calibration(CalibrationModel& model, const CalibrationData& data,
                               std::span<const int> postures, const CalibrationOptions& options) {
  return Fit(model, data, postures, options).run();
}

}  // namespace thing_kin
