#pragma once

#include <vector>

#include "thing_kin/estimation/gaussian_filter.hpp"

namespace thing_kin {

/// What a filter leaves behind for the smoother: one transition a row, into that row.
class TransitionRecord {
 public:
  TransitionRecord(int n, Eigen::Index count);

  void store(Eigen::Index row, const Transition& transition);
  const double* F(Eigen::Index row) const { return F_.data() + row * n_ * n_; }
  const double* Q(Eigen::Index row) const { return Q_.data() + row * n_ * n_; }
  const double* x(Eigen::Index row) const { return x_.data() + row * n_; }

 private:
  Eigen::Index n_;
  std::vector<double> F_, Q_, x_;
};

/// Rauch, Tung & Striebel 1965 over a filtered record, x (N, n) and P (N, n, n): C = P F^T P'^-1,
/// P' = F P F^T + Q of the next row, and in Joseph's form, which adds what is positive,
///   x_s = x + C (x_s' - x'), P_s = (I - C F) P (I - C F)^T + C (P_s' + Q) C^T.
/// With F and Q linearized statistically it is the unscented smoother of Särkkä 2008.
void smooth_record(const TransitionRecord& record, const AngleSet& angles, Eigen::Index count,
                   int n, const double* x, const double* P, double* x_smooth, double* P_smooth);

}  // namespace thing_kin
