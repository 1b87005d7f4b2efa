#include "thing_kin/estimation/calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <utility>

#include <Eigen/Eigenvalues>
#include <ceres/ceres.h>

#include "thing_kin/core/chi_square.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/estimation/calibration_start.hpp"
#include "thing_kin/lie/so3.hpp"

// Ceres' types stay here.

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using BlockMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

constexpr double kRoughly = 1e-4;   // of the cost: while the noise is sought
constexpr double kExactly = 1e-12;  // of the cost
constexpr double kSameNoise = 0.03;
constexpr double kLeastNoise = 1e-7;  // m, rad: nothing is measured better

// All residuals at once, when Ceres says that the values are new.
class Evaluation : public ceres::EvaluationCallback {
 public:
  Evaluation(CalibrationResiduals& residuals, CalibrationState& state)
      : residuals_(residuals), state_(state), J_(residuals.rows(), residuals.size()) {}

  void PrepareForEvaluation(bool jacobians, bool is_new) override {
    if (is_new || (jacobians && !has_jacobian_)) {
      residuals_.evaluate(state_, r_, jacobians ? &J_ : nullptr);
      has_jacobian_ = jacobians;
    }
  }

  const VectorXd& r() const { return r_; }
  const RowMajorMatrix& J() const { return J_; }

 private:
  CalibrationResiduals& residuals_;
  CalibrationState& state_;
  VectorXd r_;
  RowMajorMatrix J_;
  bool has_jacobian_ = false;
};

// One measurement.
class BlockCost : public ceres::CostFunction {
 public:
  BlockCost(const Evaluation& all, Index row, int m, int parameters) : all_(all), row_(row) {
    set_num_residuals(m);
    mutable_parameter_block_sizes()->push_back(parameters);
  }

  bool Evaluate(double const* const* /*parameters*/, double* residuals,
                double** jacobians) const override {
    const Index m = num_residuals();
    Eigen::Map<VectorXd>(residuals, m) = all_.r().segment(row_, m);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      const double* const first = all_.J().row(row_).data();
      std::copy(first, first + m * all_.J().cols(), jacobians[0]);
    }
    return Eigen::Map<const VectorXd>(residuals, m).allFinite();
  }

 private:
  const Evaluation& all_;
  Index row_;
};

// What is known before, and what keeps a parameter that the data don't tell where it is.
class PriorCost : public ceres::CostFunction {
 public:
  explicit PriorCost(std::span<const CalibrationParameter> parameters) : parameters_(parameters) {
    const auto p = static_cast<int>(parameters.size());
    set_num_residuals(p);
    mutable_parameter_block_sizes()->push_back(p);
  }

  bool Evaluate(double const* const* values, double* residuals, double** jacobians) const override {
    const auto p = static_cast<Index>(parameters_.size());
    for (Index i = 0; i < p; ++i) {
      residuals[i] = values[0][i] / parameters_[static_cast<std::size_t>(i)].deviation;
    }
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<RowMajorMatrix> J(jacobians[0], p, p);
      J.setZero();
      for (Index i = 0; i < p; ++i) {
        J(i, i) = 1.0 / parameters_[static_cast<std::size_t>(i)].deviation;
      }
    }
    return true;
  }

 private:
  std::span<const CalibrationParameter> parameters_;
};

// The usual constants for one residual, 95 % efficient, as multiples of its 95 % quantile.
double standard_scale(CalibrationLoss loss, int m) {
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

std::unique_ptr<ceres::LossFunction> make_loss(CalibrationLoss loss, double scale) {
  switch (loss) {
    case CalibrationLoss::kHuber:
      return std::make_unique<ceres::HuberLoss>(scale);
    case CalibrationLoss::kSoftL1:
      return std::make_unique<ceres::SoftLOneLoss>(scale);
    case CalibrationLoss::kCauchy:
      return std::make_unique<ceres::CauchyLoss>(scale);
    case CalibrationLoss::kTukey:
      return std::make_unique<ceres::TukeyLoss>(scale);
    case CalibrationLoss::kLinear:
      break;
  }
  return std::make_unique<ceres::TrivialLoss>();
}

ceres::Solver::Options solver_options(int max_iterations, double tolerance) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = max_iterations;
  options.initial_trust_region_radius = 1e6;
  options.function_tolerance = tolerance;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  return options;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

class Fit {
 public:
  Fit(CalibrationModel& model, const CalibrationData& data, std::span<const int> postures,
      const CalibrationOptions& options)
      : model_(model),
        data_(data),
        options_(options),
        residuals_(model, data, postures),
        m_(data.rows()) {
    CalibrationState nominal{options.base, options.tool, VectorXd::Zero(model.size())};
    fit_.state = calibration_start(model, data, postures, nominal);
    fit_.blocks.assign(residuals_.blocks().begin(), residuals_.blocks().end());
  }

  CalibrationFit run() {
    if (fit_.blocks.empty()) {
      finish(true);
      return std::move(fit_);
    }
    estimates_noise_ = data_.covariances.empty();
    if (estimates_noise_) {
      first_noise();
    }
    constexpr int kRounds = 12;
    for (int round = 0; round < kRounds; ++round) {
      residuals_.weigh(fit_.state, fit_.noise);
      const bool is_first = round == 0 && options_.loss != CalibrationLoss::kLinear;
      solve(is_first ? CalibrationLoss::kHuber : options_.loss, kRoughly);
      if (!estimates_noise_) {
        break;
      }
      look();
      if (rescale(round) < kSameNoise && round > 0) {
        break;
      }
    }
    residuals_.weigh(fit_.state, fit_.noise);
    const bool converged = solve(options_.loss, kExactly);
    finish(converged);
    return std::move(fit_);
  }

 private:
  bool solve(CalibrationLoss loss, double tolerance) {
    fit_.state = model_.recentered(fit_.state);
    Evaluation evaluation(residuals_, fit_.state);
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.evaluation_callback = &evaluation;
    ownership.disable_all_safety_checks = true;
    const std::unique_ptr<ceres::LossFunction> function = make_loss(loss, scale_of(loss));
    std::deque<BlockCost> costs;  // which never moves them
    PriorCost prior(model_.parameters());
    ceres::Problem problem(ownership);
    double* const values = fit_.state.values.data();
    for (std::size_t b = 0; b < fit_.blocks.size(); ++b) {
      costs.emplace_back(evaluation, static_cast<Index>(b) * m_, m_, model_.size());
      problem.AddResidualBlock(&costs.back(),
                               loss == CalibrationLoss::kLinear ? nullptr : function.get(), values);
    }
    problem.AddResidualBlock(&prior, nullptr, values);
    ceres::Solver::Summary summary;
    ceres::Solve(solver_options(options_.max_iterations, tolerance), &problem, &summary);
    fit_.iterations += static_cast<int>(summary.iterations.size());
    fit_.state = model_.recentered(fit_.state);
    return summary.termination_type == ceres::CONVERGENCE;
  }

  double scale_of(CalibrationLoss loss) const {
    return std::isnan(options_.loss_scale) || loss != options_.loss ? standard_scale(loss, m_)
                                                                    : options_.loss_scale;
  }

  // From the errors that the start leaves.
  void first_noise() {
    VectorXd e;
    residuals_.errors(fit_.state, e, nullptr);
    const auto typical = [&](Index first, Index count) {
      std::vector<double> squares;
      for (Index row = 0; row < e.size(); row += m_) {
        squares.push_back(e.segment(row + first, count).squaredNorm() / static_cast<double>(count));
      }
      return squares.empty() ? 1e-3 : std::max(std::sqrt(median_of(squares)), 1e-5);
    };
    const Index k = data_.position_rows();
    fit_.noise.position = typical(0, k);
    fit_.noise.rotation = m_ > k ? typical(k, m_ - k) : fit_.noise.rotation;
  }

  // Residuals and derivatives at the state, and what the parameters take of them.
  void look() {
    J_.resize(residuals_.rows(), residuals_.size());
    residuals_.evaluate(fit_.state, r_, &J_);
    H_ = leverages(J_, model_.parameters(), m_);
  }

  double squares(std::size_t block) const {
    return r_.segment(static_cast<Index>(block) * m_, m_).squaredNorm();
  }

  // Rows [first, first + count) of each block: squares for each degree of freedom.
  double factor(Index first, Index count, bool by_median) const {
    const double gate = chi_square_quantile(0.99, m_);
    const bool is_robust = options_.loss != CalibrationLoss::kLinear;
    std::vector<double> all;
    double sum = 0.0;
    double rows = 0.0;
    double taken = 0.0;
    double every = 0.0;
    double taken_of_every = 0.0;
    for (std::size_t b = 0; b < fit_.blocks.size(); ++b) {
      const Index row = static_cast<Index>(b) * m_;
      const double square = r_.segment(row + first, count).squaredNorm();
      const double share = H_.block(row, 0, m_, m_).diagonal().segment(first, count).sum();
      all.push_back(square);
      every += static_cast<double>(count);
      taken_of_every += share;
      if (!is_robust || squares(b) < gate) {
        sum += square;
        rows += static_cast<double>(count);
        taken += share;
      }
    }
    if (by_median) {
      const double median = chi_square_quantile(0.5, static_cast<int>(count));
      return median_of(all) / median * every / std::max(every - taken_of_every, 1e-300);
    }
    const double truncation = is_robust ? chi_square_probability(gate, m_ + 2) / 0.99 : 1.0;
    return rows - taken > 0.5 ? sum / ((rows - taken) * truncation) : 1.0;
  }

  // Fits the noise to the residuals; returns by how much it changed, relatively.
  double rescale(int round) {
    const double left = static_cast<double>(residuals_.rows()) - leverage_sum();
    fit_.noise_is_estimated = left >= kLeastFreedom;
    if (!fit_.noise_is_estimated) {
      fit_.noise = CalibrationNoise{};
      return round > 1 ? 0.0 : 1.0;
    }
    const Index k = data_.position_rows();
    const bool by_median = options_.loss != CalibrationLoss::kLinear && round < 1;
    const auto updated = [&](double before, Index first, Index count) {
      return std::max(before * std::sqrt(factor(first, count, by_median)), kLeastNoise);
    };
    const CalibrationNoise before = fit_.noise;
    fit_.noise.position = updated(before.position, 0, k);
    if (m_ > k) {
      fit_.noise.rotation = updated(before.rotation, k, m_ - k);
    }
    return by_median ? 1.0
                     : std::max(std::abs(fit_.noise.position / before.position - 1.0),
                                std::abs(fit_.noise.rotation / before.rotation - 1.0));
  }

  double leverage_sum() const {
    double sum = 0.0;
    for (Index row = 0; row < H_.rows(); ++row) {
      sum += H_(row, row % m_);
    }
    return sum;
  }

  // How much wider the loss makes the covariance than least squares would: Huber 1981, with the
  // divergence of w(|r|) r for a residual of several components.
  double inflation() const {
    if (options_.loss == CalibrationLoss::kLinear) {
      return 1.0;
    }
    const auto function = make_loss(options_.loss, scale_of(options_.loss));
    double squared = 0.0;
    double slope = 0.0;
    for (std::size_t b = 0; b < fit_.blocks.size(); ++b) {
      std::array<double, 3> rho{};
      const double s = squares(b);
      function->Evaluate(s, rho.data());
      squared += rho[1] * rho[1] * s / m_;
      slope += rho[1] + 2.0 * rho[2] * s / m_;
    }
    const auto n = static_cast<double>(fit_.blocks.size());
    const double freedom = std::max(n - leverage_sum() / m_, 1.0);
    const double mean = slope / n;
    return mean > 0.05 ? std::clamp(squared / freedom / (mean * mean), 0.5, 100.0) : 100.0;
  }

  // A residual's own covariance is I - H; along what the parameters take whole it tells nothing.
  void judge() {
    const double bound = chi_square_quantile(options_.gate, m_);
    fit_.distances.resize(static_cast<Index>(fit_.blocks.size()));
    fit_.outliers.assign(fit_.blocks.size(), false);
    for (std::size_t b = 0; b < fit_.blocks.size(); ++b) {
      const Index row = static_cast<Index>(b) * m_;
      const BlockMatrix own = BlockMatrix::Identity(m_, m_) - H_.middleRows(row, m_);
      const Eigen::SelfAdjointEigenSolver<BlockMatrix> eigen(0.5 * (own + own.transpose()));
      const VectorXd along = eigen.eigenvectors().transpose() * r_.segment(row, m_);
      double square = 0.0;
      for (Index i = 0; i < m_; ++i) {
        const double variance = eigen.eigenvalues()[i];
        square += variance > 0.01 ? along[i] * along[i] / variance : 0.0;
      }
      fit_.distances[static_cast<Index>(b)] = std::sqrt(square);
      fit_.outliers[b] = square > bound;
    }
  }

  void finish(bool converged) {
    residuals_.weigh(fit_.state, fit_.noise);
    look();
    fit_.sight = calibration_sight(J_, model_.parameters(), inflation());
    fit_.dof = static_cast<double>(residuals_.rows()) - leverage_sum();
    fit_.variance_factor = fit_.dof >= kLeastFreedom ? factor(0, m_, false) : 1.0;
    judge();
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

  static constexpr double kLeastFreedom = 1.0;

  CalibrationModel& model_;
  const CalibrationData& data_;
  const CalibrationOptions& options_;
  CalibrationResiduals residuals_;
  CalibrationFit fit_;
  int m_;
  bool estimates_noise_ = false;
  VectorXd r_;
  RowMajorMatrix J_;
  RowMajorMatrix H_;
};

}  // namespace

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

CalibrationFit fit_calibration(CalibrationModel& model, const CalibrationData& data,
                               std::span<const int> postures, const CalibrationOptions& options) {
  return Fit(model, data, postures, options).run();
}

}  // namespace thing_kin
