#pragma once

#include <chrono>
#include <limits>

#include "thing_kin/inverse/kdl_ik.hpp"
#include "thing_kin/inverse/pose_residual.hpp"

namespace thing_kin {

/// One solve of KdlIk: its attempts in order, and the best of them.
class KdlIkSearch {
 public:
  KdlIkSearch(KdlIk& solver, const SE3& target, const double* seed, const KdlIkOptions& options);

  IkResult run();

 private:
  JointVector sample() noexcept;
  bool attempt(const JointVector& start);
  bool is_reached(const PoseResidual::Value& value) const noexcept;
  double elapsed() const noexcept;
  IkStatus reason() const noexcept;

  KdlIk& solver_;
  const KdlIkOptions& options_;
  PoseResidual residual_;
  LowDiscrepancy samples_;
  JointVector lower_, range_;  // of the samples
  JointVector home_;           // what endless joints are wound towards
  bool has_seed_;
  std::chrono::steady_clock::time_point begin_;
  JointVector best_;
  PoseResidual::Value value_;  // at best_
  double least_ = std::numeric_limits<double>::infinity();
  bool beyond_limits_ = false;  // whether a solution was found that the limits forbid
  std::uint64_t drawn_ = 0;
  int iterations_ = 0;
  int attempts_ = 0;
};

}  // namespace thing_kin
