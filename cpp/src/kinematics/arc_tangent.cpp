#include "thing_kin/kinematics/arc_tangent.hpp"

#include "kernels/kernels.hpp"

namespace thing_kin {

void arc_tangents(const double* sine, const double* cosine, long count, double* angle) noexcept {
  kernels().arc_tangents(sine, cosine, count, angle);
}

}  // namespace thing_kin
