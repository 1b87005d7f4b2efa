#pragma once

#include <chrono>
#include <vector>

#include "pose_starts.hpp"

namespace thing_kin {

/// One solve of a PosePlanner.
class PoseSearch {
 public:
  PoseSearch(const PosePlanner& planner, const SE3& target, const double* seed);

  PosePlan run();

 private:
  using Starts = std::array<JointVector, ClosedFormSolutions::kMost>;

  struct Candidate {
    JointVector q;
    double rank;  ///< log sqrt(kappa/M), with the violation at a price
  };

  void search_near();
  void search_all();
  std::vector<Candidate> sample();
  bool try_from(const JointVector& q);
  void keep_if_better();
  void verify(PosePlan& plan) const;

  const PosePlanner& planner_;
  SE3 target_;
  JointVector seed_;
  PoseDescent descent_;
  PoseStarts starts_;
  PosePlan best_;
  double best_value_;
  double best_violation_;
  bool found_ = false;
  bool out_of_iterations_ = false;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace thing_kin
