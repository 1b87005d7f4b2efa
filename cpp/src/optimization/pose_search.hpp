#pragma once

#include <chrono>
#include <compare>
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

  /// What came of a descent, the best first; of two alike, the one with less objective or, where it
  /// is infeasible, less violation.
  enum class Kind : std::uint8_t { kOptimum, kFeasible, kInfeasible, kNone };
  struct Rank {
    Kind kind = Kind::kNone;
    double value = 0.0;
    auto operator<=>(const Rank&) const = default;
  };

  struct Candidate {
    JointVector q;
    double rank;  ///< log sqrt(kappa/M), with the violation at a price
  };

  void search_near();
  void search_all();
  std::vector<Candidate> sample();
  bool try_from(const JointVector& q);
  void verify(PosePlan& plan) const;

  const PosePlanner& planner_;
  SE3 target_;
  JointVector seed_;
  PoseDescent descent_;
  PoseStarts starts_;
  PosePlan best_;
  Rank rank_;  // of best_.q
  bool out_of_iterations_ = false;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace thing_kin
