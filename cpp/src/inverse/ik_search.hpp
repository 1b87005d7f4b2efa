#pragma once

#include <chrono>
#include <limits>

#include "closest_pose.hpp"
#include "ik_descent.hpp"
#include "ik_samples.hpp"
#include "thing_kin/inverse/numeric_ik.hpp"

namespace thing_kin {

/// One solve of NumericIk: its attempts in order, and the best of them.
class IkSearch {
 public:
  IkSearch(const NumericIk& solver, const SE3& target, const double* seed) noexcept;

  IkResult run() noexcept;

 private:
  bool attempt(const JointVector& start) noexcept;
  bool restart() noexcept;
  void search_nearer() noexcept;
  void settle(IkPoint& point) noexcept;
  double distance_from_seed(const JointVector& q) const noexcept;
  double elapsed() const noexcept;
  IkResult found() noexcept;
  IkResult failed() noexcept;
  IkStatus reason(const Rest& rest) const noexcept;
  IkResult result(IkStatus status) const noexcept;

  const NumericIk& solver_;
  const IkOptions& options_;
  bool has_seed_;
  JointVector seed_;
  IkProblem problem_;
  IkSamples samples_;
  std::chrono::steady_clock::time_point begin_;
  IkPoint best_;
  double least_ = std::numeric_limits<double>::infinity();
  int iterations_ = 0;
  int attempts_ = 0;
};

}  // namespace thing_kin
