#include "thing_kin/inverse/step_limit.hpp"

#include <algorithm>
#include <cmath>

namespace thing_kin {

namespace {

// A joint at its limit may pass it by this fraction, once more for each level that is fitted, until
// the step itself is clamped. Without it, rounding in a joint that is full and that a lower level
// hardly moves would drop the whole level.
constexpr double kLimitSlack = 1e-12;

// The largest s in [0, 1] with |total + s c| <= limit in every joint, c being the contribution of
// `level`; -1 if there is none.
double largest_scale(const JointVector& limit, int level, const JointVector& total,
                     const JointVector& c) {
  const double slack = 1.0 + kLimitSlack * (level + 1);
  double low = 0.0;
  double high = 1.0;
  for (Eigen::Index j = 0; j < c.size(); ++j) {
    const double bound = limit[j] * slack;
    if (c[j] == 0.0) {
      if (std::abs(total[j]) > bound) {
        return -1.0;
      }
      continue;
    }
    high = std::min(high, (std::copysign(bound, c[j]) - total[j]) / c[j]);
    low = std::max(low, (-std::copysign(bound, c[j]) - total[j]) / c[j]);
  }
  return low <= high ? high : -1.0;
}

// Sum of the contributions of the first `count` levels, whole. From the top: a lower one may be so
// much larger that the higher would be lost in a difference.
JointVector sum_of(const TaskPriorityStep& step, int count) {
  JointVector sum = JointVector::Zero(step.dq.size());
  for (int i = 0; i < count; ++i) {
    sum += step.levels[static_cast<std::size_t>(i)].contribution;
  }
  return sum;
}

}  // namespace

void scale_to_limit(const JointVector& limit, TaskPriorityStep& step) noexcept {
  const auto level = [&](int i) -> TaskPriorityStep::Level& {
    return step.levels[static_cast<std::size_t>(i)];
  };
  if ((step.dq.array().abs() <= limit.array()).all()) {
    return;
  }
  // From the lowest up: drop levels until one, shortened, fits. The highest always does.
  int kept = step.count;
  double scale = -1.0;
  JointVector above;
  while (scale < 0.0) {
    --kept;
    above = sum_of(step, kept);
    scale = largest_scale(limit, kept, above, level(kept).contribution);
  }
  level(kept).scale = scale;
  step.dq = above + scale * level(kept).contribution;
  // From there down: what fits into the room that is left.
  for (int i = kept + 1; i < step.count; ++i) {
    level(i).scale = std::max(0.0, largest_scale(limit, i, step.dq, level(i).contribution));
    step.dq += level(i).scale * level(i).contribution;
  }
  step.dq = step.dq.cwiseMin(limit).cwiseMax(-limit);  // rounding only
}

}  // namespace thing_kin
