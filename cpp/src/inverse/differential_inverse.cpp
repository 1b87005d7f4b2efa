#include "thing_kin/inverse/differential_inverse.hpp"

#include <cmath>
#include <string>

#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/pseudoinverse.hpp"

namespace thing_kin {

Damped::Damped(double lambda) : damping(lambda) {
  if (!(std::isfinite(damping) && damping >= 0.0)) {
    throw InvalidArgument("damping", text(damping), "a finite number >= 0");
  }
}

SelectivelyDamped::SelectivelyDamped(double largest_step) : gamma_max(largest_step) {
  if (!(std::isfinite(gamma_max) && gamma_max > 0.0)) {
    throw InvalidArgument("gamma_max", text(gamma_max), "a finite number > 0");
  }
}

namespace {

struct Apply {
  const Svd& svd;
  const RowBlocks& blocks;
  const SmallVector& e;

  JointVector operator()(const Exact& /*inverse*/) const {
    return apply_pseudoinverse(svd, exact_gains(svd), e);
  }
  JointVector operator()(const Damped& inverse) const {
    return apply_pseudoinverse(svd, damped_gains(svd, inverse.damping), e);
  }
  JointVector operator()(const SelectivelyDamped& inverse) const {
    return selectively_damped_step(svd, blocks, e, inverse.gamma_max);
  }
};

}  // namespace

JointVector apply_inverse(const DifferentialInverse& inverse, const Svd& svd,
                          const RowBlocks& blocks, const SmallVector& e) noexcept {
  return std::visit(Apply{svd, blocks, e}, inverse);
}

}  // namespace thing_kin
