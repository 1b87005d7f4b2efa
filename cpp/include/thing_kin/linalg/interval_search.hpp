#pragma once

#include "thing_kin/core/types.hpp"

namespace thing_kin {

/// The alpha > 0 at which v + alpha s is nearest to the intervals [lower, upper], by the sum of the
/// squares of what is outside; 1 where it does not matter. v + s is the minimum for those that are
/// outside at v: Newton's step.
double interval_search(const SmallVector& v, const SmallVector& s, const SmallVector& lower,
                       const SmallVector& upper) noexcept;

}  // namespace thing_kin
