#include "thing_kin/inverse/kdl_ik.hpp"

#include "kdl_ik_search.hpp"
#include "thing_kin/inverse/numeric_ik.hpp"

namespace thing_kin {

void KdlIkOptions::check(const Chain& chain) const {
  IkOptions common;
  common.position_tolerance = position_tolerance;
  common.rotation_tolerance = rotation_tolerance;
  common.max_iterations = max_iterations;
  common.max_restarts = max_restarts;
  common.deadline = deadline;
  common.check(chain);
}

KdlIk::KdlIk(const Chain& chain)
    : chain_(chain), kdl_(chain), box_(chain), reach_(chain, chain.tool()) {}

IkResult KdlIk::solve(const SE3& target, const double* seed, const KdlIkOptions& options) {
  options.check(chain_);
  return KdlIkSearch(*this, target, seed, options).run();
}

}  // namespace thing_kin
