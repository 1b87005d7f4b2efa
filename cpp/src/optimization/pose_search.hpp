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
    double rank;
    std::size_t first;  // of its numbers in samples_
    auto operator<=>(const Candidate&) const = default;
  };

  void search_near();
  void search_all();
  std::vector<Candidate> sample();
  bool is_apart(const JointVector& q) const;
  bool try_from(const JointVector& q);
  void verify(PosePlan& plan) const;

  const PosePlanner& planner_;
  SE3 target_;
  JointVector seed_;
  PoseDescent descent_;
  PoseStarts starts_;
  PosePlan best_;
  Rank rank_;  // of best_.q
  std::vector<double> samples_;
  std::vector<JointVector> visited_;  // where descents began and ended
  bool out_of_iterations_ = false;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace thing_kin
