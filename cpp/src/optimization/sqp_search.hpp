#pragma once

// One run of Algorithm 2.

#include <chrono>
#include <cstdint>

#include "thing_kin/optimization/sqp.hpp"

namespace thing_kin {

class SqpSearch {
 public:
  SqpSearch(const Problem& problem, const ConvexMinimizer& minimizer, const SqpOptions& options,
            const VectorView& x0);

  /// False: it ended where no step lessens the violation.
  bool penalty_loop();

  const Eigen::VectorXd& x() const { return x_; }
  int iterations() const { return iterations_; }
  SqpTrace& trace() { return trace_; }
  double seconds() const;
  bool out_of_budget() const;

 private:
  // What is minimized: scale f + penalty sum |violation| + squares sum violation^2 / 2.
  struct Merit {
    double scale;
    double penalty;
    double squares;
  };
  enum class End : std::uint8_t { kOptimal, kStationary, kBudget };
  enum class Convexity : std::uint8_t { kAcross, kClipped };

  struct Model {
    ConvexModel convex;
    Eigen::VectorXd gradient;  // before it was made convex
    Eigen::MatrixXd hessian;
    bool is_clipped = true;
  };

  // A step tried: the merit's improvement as the model has it, and as it is.
  struct Trial {
    ConvexStep step;
    Eigen::VectorXd x;
    double predicted = 0.0;
    double actual = 0.0;
  };

  End convexify_loop();
  bool trust_loop();
  bool restore();

  Model convexify(Convexity convexity) const;
  void add_curvature(Convexity convexity, Model& model) const;
  Eigen::MatrixXd held(Eigen::VectorXd& value) const;
  Trial attempt(const Model& model, const ConvexModel& solved) const;
  Trial corrected(const Model& model, const Trial& first) const;
  bool is_acceptable(const Trial& trial) const;
  bool is_polish(const Trial& trial) const;
  bool move(const Trial& trial);
  void note(bool accepted);

  double largest_violation() const;
  bool is_feasible() const;
  bool is_optimal() const;
  Eigen::VectorXd signed_violation() const;
  double merit() const { return merit(at_.objective, at_.value); }
  double merit(double objective, const VectorView& value) const;
  double least_improvement() const;
  double rounding() const;

  const Problem& problem_;
  const ConvexMinimizer& minimizer_;
  const SqpOptions& options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  Eigen::VectorXd x_;
  Linearization at_;
  Eigen::VectorXd multipliers_;  // of the last step's convex model
  Merit merit_;
  double delta_;
  int iterations_ = 0;
  int polished_ = 0;  // steps in a row below what the merit can tell
  SqpTrace trace_;
};

}  // namespace thing_kin
