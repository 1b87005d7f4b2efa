#include "thing_kin/linalg/signed_least_squares.hpp"

#include <algorithm>

#include <Eigen/QR>

#include "thing_kin/core/tolerance.hpp"

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

class ActiveSet {
 public:
  ActiveSet(const MatrixView& A, const VectorView& b, const std::vector<bool>& free)
      : A_(A), b_(b), free_(free), passive_(free), x_(VectorXd::Zero(A.cols())) {}

  VectorXd solve() {
    settle();
    const double tolerance = 10.0 * rank_tolerance(A_.rows(), A_.cols()) * b_.norm();
    for (Index i = 0; i < 3 * A_.cols(); ++i) {
      const VectorXd slope = A_.transpose() * (b_ - A_ * x_);
      Index best = -1;
      for (Index j = 0; j < A_.cols(); ++j) {
        if (!passive(j) && slope[j] > tolerance * A_.col(j).norm() &&
            (best < 0 || slope[j] > slope[best])) {
          best = j;
        }
      }
      if (best < 0) {
        break;
      }
      passive_[static_cast<std::size_t>(best)] = true;
      settle();
    }
    return x_;
  }

 private:
  bool passive(Index j) const { return passive_[static_cast<std::size_t>(j)]; }

  // The least squares of the passive columns, each column that would turn negative leaving.
  void settle() {
    for (Index i = 0; i <= A_.cols(); ++i) {
      const VectorXd y = least_squares();
      double step = 1.0;
      for (Index j = 0; j < A_.cols(); ++j) {
        if (passive(j) && !free_[static_cast<std::size_t>(j)] && y[j] <= 0.0) {
          step = std::min(step, x_[j] > 0.0 ? x_[j] / (x_[j] - y[j]) : 0.0);
        }
      }
      x_ += step * (y - x_);
      if (step == 1.0) {
        return;
      }
      for (Index j = 0; j < A_.cols(); ++j) {
        if (passive(j) && !free_[static_cast<std::size_t>(j)] && x_[j] <= 0.0) {
          passive_[static_cast<std::size_t>(j)] = false;
          x_[j] = 0.0;
        }
      }
    }
  }

  VectorXd least_squares() const {
    std::vector<Index> columns;
    for (Index j = 0; j < A_.cols(); ++j) {
      if (passive(j)) {
        columns.push_back(j);
      }
    }
    VectorXd y = VectorXd::Zero(A_.cols());
    if (!columns.empty()) {
      const Eigen::MatrixXd chosen = A_(Eigen::all, columns);
      const VectorXd of_chosen = chosen.completeOrthogonalDecomposition().solve(b_);
      y(columns) = of_chosen;
    }
    return y;
  }

  const MatrixView& A_;
  const VectorView& b_;
  const std::vector<bool>& free_;
  std::vector<bool> passive_;
  VectorXd x_;
};

}  // namespace

VectorXd signed_least_squares(const MatrixView& A, const VectorView& b,
                              const std::vector<bool>& free) {
  return ActiveSet(A, b, free).solve();
}

}  // namespace thing_kin
