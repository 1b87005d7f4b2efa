#include "thing_kin/optimization/ceres_minimizer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>
#include <glog/logging.h>

#include "smooth_model.hpp"
#include "thing_kin/core/error.hpp"

// The only file that knows Ceres. Its problems see plain matrices and never call a term.

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

double largest(const VectorXd& v) { return v.size() == 0 ? 0.0 : v.cwiseAbs().maxCoeff(); }

// A smooth model about p in residual form, with B = L L^T:
//   |L^T d + L^-1 G|^2 / 2 + sum_quadratic stiffness distance^2 / 2,  d = . - p,
// where G is the gradient at p of the quadratic part and of the penalties that are linear there.
// These have no least-squares form, and none is needed: the sum has Phi's gradient at p, and near p
// its curvature.
class Residuals : public ceres::CostFunction {
 public:
  Residuals(const SmoothModel& smooth, const MatrixXd& L, const VectorXd& p) : L_(L), p_(p) {
    const ConvexModel& model = smooth.model();
    const VectorXd distance = smooth.distance(p);
    VectorXd G = smooth.gradient(p);
    for (Index i = 0; i < distance.size(); ++i) {
      const double force = smooth.stiffness()[i] * distance[i];
      if (std::abs(force) <= smooth.penalty()[i]) {
        rows_.push_back(i);
        G -= model.jacobian.row(i).transpose() * force;
      }
    }
    const auto m = static_cast<Index>(rows_.size());
    A_ = model.jacobian(rows_, Eigen::all);
    root_ = smooth.stiffness()(rows_).cwiseSqrt();
    room_below_.resize(m);
    room_above_.resize(m);
    const VectorXd w = smooth.shifted(p);
    for (Index k = 0; k < m; ++k) {
      const Index i = rows_[static_cast<std::size_t>(k)];
      room_below_[k] = w[i] - model.lower[i];
      room_above_[k] = model.upper[i] - w[i];
    }
    start_ = L_.triangularView<Eigen::Lower>().solve(G);
    set_num_residuals(static_cast<int>(p.size() + m));
    mutable_parameter_block_sizes()->assign(static_cast<std::size_t>(p.size()), 1);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Index n = p_.size();
    VectorXd d(n);
    for (Index j = 0; j < n; ++j) {
      d[j] = *parameters[j] - p_[j];
    }
    const VectorXd along = A_ * d;
    const VectorXd outside =
        (along - room_above_).cwiseMax(0.0) - (-along - room_below_).cwiseMax(0.0);
    Eigen::Map<VectorXd> r(residuals, num_residuals());
    r.head(n) = L_.transpose() * d + start_;
    r.tail(outside.size()) = root_.cwiseProduct(outside);
    for (Index j = 0; jacobians != nullptr && j < n; ++j) {
      if (jacobians[j] != nullptr) {
        Eigen::Map<VectorXd> column(jacobians[j], num_residuals());
        column.head(n) = L_.row(j).transpose();
        column.tail(outside.size()) =
            (outside.array() != 0.0).select(root_.cwiseProduct(A_.col(j)), 0.0);
      }
    }
    return true;
  }

 private:
  const MatrixXd& L_;
  const VectorXd& p_;
  std::vector<Index> rows_;  // whose penalty is not linear at p
  MatrixXd A_;
  VectorXd root_, room_below_, room_above_, start_;
};

ceres::Solver::Options least_squares_options() {
  ceres::Solver::Options options;
  options.minimizer_type = ceres::TRUST_REGION;
  options.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  options.linear_solver_type = ceres::DENSE_QR;
  options.initial_trust_region_radius = 1e12;  // a Gauss-Newton step first: it is exact here
  options.max_trust_region_radius = 1e16;
  options.min_lm_diagonal = 1e-12;
  options.max_num_iterations = 50;
  options.min_trust_region_radius = 1e-6;
  options.max_num_consecutive_invalid_steps = 1000;  // the end of progress is no error to be logged
  options.function_tolerance = 1e-16;
  options.gradient_tolerance = 1e-16;
  options.parameter_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  return options;
}

// Minimizes a smooth model within the box: a sequence of Levenberg-Marquardt solves, each followed
// by an exact line search on Phi. Ceres keeps the bounds; variables that are pushed against theirs
// are held constant, as its steps are computed without them.
class LeastSquares {
 public:
  int minimize(const SmoothModel& smooth, VectorXd& p, double tolerance) const {
    constexpr int kMost = 40;
    const Eigen::LLT<MatrixXd> cholesky(smooth.hessian());
    const MatrixXd L = cholesky.matrixL();
    int iterations = 0;
    for (int i = 0; i < kMost; ++i) {
      VectorXd q = p;
      iterations += solve(smooth, L, p, q);
      const double t = smooth.line_search(p, q);
      const double step = t * largest(q - p);
      p += t * (q - p);
      p = p.cwiseMax(smooth.model().box_lower).cwiseMin(smooth.model().box_upper);
      if (!(step > tolerance)) {
        break;
      }
    }
    return iterations;
  }

 private:
  static int solve(const SmoothModel& smooth, const MatrixXd& L, const VectorXd& p, VectorXd& q) {
    const ConvexModel& model = smooth.model();
    const VectorXd slope = smooth.gradient(p);
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ownership);
    Residuals residuals(smooth, L, p);
    std::vector<double*> blocks;
    blocks.reserve(static_cast<std::size_t>(q.size()));
    for (double& x : q) {
      blocks.push_back(&x);
    }
    problem.AddResidualBlock(&residuals, nullptr, blocks);
    bool is_free = false;
    for (Index j = 0; j < q.size(); ++j) {
      double* const block = blocks[static_cast<std::size_t>(j)];
      const bool is_held = (p[j] <= model.box_lower[j] && slope[j] >= 0.0) ||
                           (p[j] >= model.box_upper[j] && slope[j] <= 0.0);
      if (is_held) {
        problem.SetParameterBlockConstant(block);
        continue;
      }
      is_free = true;
      problem.SetParameterLowerBound(block, 0, model.box_lower[j]);
      problem.SetParameterUpperBound(block, 0, model.box_upper[j]);
    }
    if (!is_free) {
      return 0;
    }
    static const ceres::Solver::Options options = least_squares_options();
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return static_cast<int>(summary.iterations.size());
  }
};

// Ceres' line search warns on stderr where the function is flat to rounding, which is how it ends
// here. The level is the process's: the first of several threads lowers it, the last restores it.
class Silence {
 public:
  Silence() {
    const std::scoped_lock lock(mutex());
    if (count()++ == 0) {
      level() = FLAGS_minloglevel;
      FLAGS_minloglevel = google::GLOG_ERROR;
    }
  }
  ~Silence() {
    const std::scoped_lock lock(mutex());
    if (--count() == 0) {
      FLAGS_minloglevel = level();
    }
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  Silence(Silence&&) = delete;
  Silence& operator=(Silence&&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  static int& count() {
    static int threads = 0;
    return threads;
  }
  static int& level() {
    static int before = 0;
    return before;
  }
};

// The smooth model of all variables, for a line search.
class Function : public ceres::FirstOrderFunction {
 public:
  explicit Function(const SmoothModel& smooth) : smooth_(smooth) {}

  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    const Eigen::Map<const VectorXd> p(parameters, NumParameters());
    *cost = smooth_.value(p);
    if (gradient != nullptr) {
      Eigen::Map<VectorXd>(gradient, NumParameters()) = smooth_.gradient(p);
    }
    return std::isfinite(*cost);
  }

  int NumParameters() const override { return static_cast<int>(smooth_.model().variables()); }

 private:
  const SmoothModel& smooth_;
};

class Bfgs {
 public:
  int minimize(const SmoothModel& smooth, VectorXd& p, double tolerance) const {
    ceres::GradientProblemSolver::Options options;
    options.line_search_direction_type = ceres::BFGS;
    options.use_approximate_eigenvalue_bfgs_scaling = true;
    options.max_num_iterations = 300;
    options.function_tolerance = 1e-16;
    options.gradient_tolerance = 1e-2 * tolerance;
    options.parameter_tolerance = 1e-2 * tolerance;
    options.logging_type = ceres::SILENT;
    const ceres::GradientProblem problem(new Function(smooth));
    ceres::GradientProblemSolver::Summary summary;
    const Silence silence;
    ceres::Solve(options, problem, p.data(), &summary);
    return static_cast<int>(summary.iterations.size());
  }
};

constexpr double kAccuracy = 1e-9;
constexpr double kMostStiffening = 1e6;

// What the model's numbers are like.
struct Scales {
  explicit Scales(const ConvexModel& model)
      : radius(std::max(1e-12, largest(model.box_upper - model.box_lower))),
        slope(std::max(
            {1e-12, largest(model.gradient),
             model.rows() == 0 ? 0.0 : model.penalty * model.jacobian.cwiseAbs().maxCoeff()})),
        curvature(std::max({model.hessian.cwiseAbs().maxCoeff(), largest(model.gradient) / radius,
                            1e-3 * slope / radius})) {}

  double radius, slope, curvature;
};

// 1e-9 of the step, which may be small itself, but no less than rounding.
double accuracy_at(const VectorXd& p, const Scales& scales) {
  return std::max(1e-14, kAccuracy * std::min({1.0, scales.radius, largest(p)}));
}

// So weak that what is flat may move a thousand boxes; so strong that there is a Cholesky factor.
double proximity_of(const ConvexModel& model, const Scales& scales) {
  return std::max(1e-3 * largest(model.gradient) / scales.radius, 1e-9 * scales.curvature);
}

VectorXd row_norms(const ConvexModel& model) {
  VectorXd norms = model.jacobian.rowwise().norm();
  return (norms.array() > 1e-12).select(norms, 1.0);
}

// Multiplier and proximal iterations together: the proximal method of multipliers. The last
// `strict` rows must hold.
template <typename Smooth>
ConvexStep augmented_lagrangian(const ConvexModel& model, Index strict, const Smooth& minimizer) {
  constexpr int kMost = 60;
  const Scales scales(model);
  const VectorXd norms = row_norms(model);
  SmoothModel smooth(model);
  smooth.penalty().tail(strict).setConstant(std::numeric_limits<double>::infinity());
  smooth.stiffness() = (100.0 * scales.curvature / norms.array().square()).matrix();
  ConvexStep step{VectorXd::Zero(model.variables()), VectorXd::Zero(model.rows()), 0};
  const double proximity = proximity_of(model, scales);
  const double stiffest = kMostStiffening * largest(smooth.stiffness());
  double left = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMost; ++i) {
    smooth.set_proximity(proximity, step.p);
    smooth.multipliers() = step.multipliers;
    VectorXd p = step.p;
    step.iterations += minimizer.minimize(smooth, p, accuracy_at(p, scales));
    const VectorXd y = smooth.pull(smooth.distance(p));
    const double moved = largest(p - step.p);
    const VectorXd gap = (y - step.multipliers).cwiseQuotient(smooth.stiffness());
    const double now = largest(gap.cwiseQuotient(norms));
    step.p = p;
    step.multipliers = y;
    if (std::max(moved, now) <= accuracy_at(p, scales)) {
      break;
    }
    if (now > 0.1 * left && largest(smooth.stiffness()) < stiffest) {
      smooth.stiffness() *= 10.0;
    }
    left = now;
  }
  return step;
}

ConvexStep smoothed(const ConvexModel& model, const LeastSquares& minimizer) {
  const Scales scales(model);
  ConvexStep step{VectorXd::Zero(model.variables()), VectorXd::Zero(model.rows()), 0};
  SmoothModel smooth(model);
  const double proximity = 30.0 * proximity_of(model, scales);  // stiff: less of a way per step
  double width = 0.1;
  while (width > 0.5 * kAccuracy) {
    smooth.stiffness().setConstant(model.penalty / width);
    for (int i = 0; i < 20; ++i) {
      smooth.set_proximity(proximity, step.p);
      VectorXd p = step.p;
      step.iterations += minimizer.minimize(smooth, p, accuracy_at(p, scales));
      const double moved = largest(p - step.p);
      step.p = p;
      if (moved <= std::max(width * std::min(1.0, largest(p)), accuracy_at(p, scales))) {
        break;
      }
    }
    width *= 0.1;
  }
  step.multipliers = smooth.pull(smooth.distance(step.p));
  return step;
}

// The box as further rows.
ConvexModel with_box_rows(const ConvexModel& model) {
  const Index m = model.rows();
  const Index n = model.variables();
  ConvexModel all = model;
  all.value.conservativeResize(m + n);
  all.jacobian.conservativeResize(m + n, n);
  all.lower.conservativeResize(m + n);
  all.upper.conservativeResize(m + n);
  all.value.tail(n).setZero();
  all.jacobian.bottomRows(n).setIdentity();
  all.lower.tail(n) = model.box_lower;
  all.upper.tail(n) = model.box_upper;
  return all;
}

class CeresMinimizer : public ConvexMinimizer {
 public:
  explicit CeresMinimizer(CeresMethod method) : method_(method) {}

  ConvexStep minimize(const ConvexModel& model) const override {
    switch (method_) {
      case CeresMethod::kSmoothed:
        return smoothed(model, LeastSquares());
      case CeresMethod::kBfgs: {
        ConvexStep step = augmented_lagrangian(with_box_rows(model), model.variables(), Bfgs());
        step.p = step.p.cwiseMax(model.box_lower).cwiseMin(model.box_upper);
        step.multipliers.conservativeResize(model.rows());
        return step;
      }
      case CeresMethod::kAugmentedLagrangian:
        break;
    }
    return augmented_lagrangian(model, 0, LeastSquares());
  }

 private:
  CeresMethod method_;
};

}  // namespace

CeresMethod ceres_method_from_string(const std::string& name) {
  constexpr std::array<std::pair<const char*, CeresMethod>, 3> kMethods{
      {{"augmented_lagrangian", CeresMethod::kAugmentedLagrangian},
       {"smoothed", CeresMethod::kSmoothed},
       {"bfgs", CeresMethod::kBfgs}}};
  for (const auto& [text, method] : kMethods) {
    if (name == text) {
      return method;
    }
  }
  throw InvalidArgument("minimizer", quoted(name), "'augmented_lagrangian', 'smoothed' or 'bfgs'");
}

std::unique_ptr<ConvexMinimizer> make_ceres_minimizer(CeresMethod method) {
  return std::make_unique<CeresMinimizer>(method);
}

}  // namespace thing_kin
