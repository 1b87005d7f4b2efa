#pragma once

#include "pose_descent.hpp"
#include "thing_kin/inverse/ik_samples.hpp"

namespace thing_kin {

/// Where descents may begin: solutions of inverse kinematics for base placements within the disc
/// and the window of heading. Those of an arm with a closed form, all branches at once; where it
/// has none from a placement, and for other arms, one by numerical inverse kinematics, which moves
/// the base too.
class PoseStarts {
 public:
  PoseStarts(const PosePlanner& planner, const IkProblem& ik, const SE3& target,
             const JointVector& seed);

  /// The starts of the next sample, at most as many as there are branches; none where the target is
  /// out of reach from there. Each is within the box.
  int next(std::array<JointVector, ClosedFormSolutions::kMost>& starts);

  /// Whether further samples give nothing new.
  bool exhausted() const { return exhausted_; }

 private:
  void draw_base(double* base) noexcept;
  int by_closed_form(std::array<JointVector, ClosedFormSolutions::kMost>& starts);
  int by_descent(JointVector& start);

  const PosePlanner& planner_;
  const IkProblem& ik_;
  const SE3& target_;
  const JointVector& seed_;
  IkSamples samples_;
  std::uint64_t drawn_ = 0;
  bool exhausted_ = false;
};

}  // namespace thing_kin
