#include "thing_kin/estimation/calibration_descent.hpp"

#include <algorithm>
#include <deque>

#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

// Ceres' types stay here.

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

// All residuals at once, when Ceres says that the values are new. With their derivatives, for
// nearly each step is accepted, and then they are asked for.
class Evaluation : public ceres::EvaluationCallback {
 public:
  Evaluation(CalibrationResiduals& residuals, CalibrationDescent& descent)
      : residuals_(residuals), descent_(descent) {
    descent.J.resize(residuals.rows(), residuals.size());
  }

  void PrepareForEvaluation(bool /*jacobians*/, bool is_new) override {
    if (is_new) {
      residuals_.evaluate(descent_.state, descent_.r, &descent_.J);
      at_ = descent_.state.values;
    }
  }

  // Ceres leaves the last step out that says that it has converged; here it counts.
  void settle(bool converged) {
    if (converged && descent_.r.allFinite()) {
      descent_.state.values = at_;
    } else {
      residuals_.evaluate(descent_.state, descent_.r, &descent_.J);
    }
  }

 private:
  CalibrationResiduals& residuals_;
  CalibrationDescent& descent_;
  VectorXd at_;
};

// One measurement.
class BlockCost : public ceres::CostFunction {
 public:
  BlockCost(const CalibrationDescent& all, Index row, int m, int parameters)
      : all_(all), row_(row) {
    set_num_residuals(m);
    mutable_parameter_block_sizes()->push_back(parameters);
  }

  bool Evaluate(double const* const* /*parameters*/, double* residuals,
                double** jacobians) const override {
    const Index m = num_residuals();
    Eigen::Map<VectorXd>(residuals, m) = all_.r.segment(row_, m);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      std::copy_n(all_.J.row(row_).data(), m * all_.J.cols(), jacobians[0]);
    }
    return Eigen::Map<const VectorXd>(residuals, m).allFinite();
  }

 private:
  const CalibrationDescent& all_;
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

class Loss : public ceres::LossFunction {
 public:
  Loss(CalibrationLoss loss, double scale) : loss_(loss), scale_(scale) {}

  void Evaluate(double square, double rho[3]) const override {
    std::ranges::copy(loss_at(loss_, scale_, square), rho);
  }

 private:
  CalibrationLoss loss_;
  double scale_;
};

ceres::Solver::Options solver_options(const CalibrationDescentOptions& asked) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = asked.max_iterations;
  options.initial_trust_region_radius = 1e6;
  options.function_tolerance = asked.tolerance;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  return options;
}

}  // namespace

CalibrationDescent descend_calibration(CalibrationResiduals& residuals,
                                       std::span<const CalibrationParameter> parameters,
                                       const CalibrationState& start,
                                       const CalibrationDescentOptions& options) {
  CalibrationDescent descent;
  descent.state = start;
  Evaluation evaluation(residuals, descent);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.evaluation_callback = &evaluation;
  ownership.disable_all_safety_checks = true;
  Loss loss(options.loss, options.loss_scale);
  std::deque<BlockCost> costs;  // which never moves them
  PriorCost prior(parameters);
  ceres::Problem problem(ownership);
  double* const values = descent.state.values.data();
  const int m = residuals.data().rows();
  for (int row = 0; row < residuals.rows(); row += m) {
    costs.emplace_back(descent, row, m, residuals.size());
    problem.AddResidualBlock(&costs.back(),
                             options.loss == CalibrationLoss::kLinear ? nullptr : &loss, values);
  }
  problem.AddResidualBlock(&prior, nullptr, values);
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(options), &problem, &summary);
  descent.iterations = static_cast<int>(summary.iterations.size());
  descent.converged = summary.termination_type == ceres::CONVERGENCE;
  evaluation.settle(descent.converged);
  return descent;
}

}  // namespace thing_kin
