#pragma once

#include "thing_kin/optimization/convex_model.hpp"

namespace thing_kin {

/// The convex model as an elastic quadratic program: a slack for each side of each constraint, at
/// the price of the penalty. By a primal-dual interior point method with Mehrotra's predictor and
/// corrector, condensed to one (n, n) system an iteration; there is always an interior, also with
/// contradicting or linearly dependent constraints.
class ElasticQp : public ConvexMinimizer {
 public:
  ConvexStep minimize(const ConvexModel& model) const override;
};

}  // namespace thing_kin
