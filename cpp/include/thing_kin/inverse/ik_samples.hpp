#pragma once

#include "thing_kin/core/low_discrepancy.hpp"
#include "thing_kin/inverse/ik_descent.hpp"
#include "thing_kin/inverse/reach.hpp"

namespace thing_kin {

/// Where descents begin anew: of a few low-discrepancy configurations, sliding joints at the root
/// moved so that the hand is at the target as nearly as may be, the one nearest to the target.
class IkSamples {
 public:
  IkSamples(const IkProblem& problem, const LowDiscrepancy& sequence, const Reach& reach) noexcept;

  void next(JointVector& q) noexcept;

  /// The middle of what is sampled.
  JointVector middle() const noexcept;

 private:
  void draw(double* q) noexcept;

  const IkProblem& problem_;
  const LowDiscrepancy& sequence_;
  const Reach& reach_;
  JointVector lower_, range_;
  std::uint64_t drawn_ = 0;
};

}  // namespace thing_kin
