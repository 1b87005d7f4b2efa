#include "thing_kin/kinematics/jacobian.hpp"

#include "kernels/arguments.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin {

ReferenceFrame reference_frame_from_string(const std::string& name) {
  if (name == "world_aligned") {
    return ReferenceFrame::kWorldAligned;
  }
  if (name == "body") {
    return ReferenceFrame::kBody;
  }
  if (name == "world") {
    return ReferenceFrame::kWorld;
  }
  throw InvalidArgument("frame", quoted(name), "'world_aligned', 'body' or 'world'");
}

void geometric_jacobian(const Chain& chain, const Posture& posture, const MovingPoint& of,
                        ReferenceFrame reference, Jacobian& J) noexcept {
  J.resize(6, chain.dof());
  kernels().jacobian(chain.skeleton(), skeleton_frame_at(chain, of), posture.columns,
                     to_kernel(reference), J.data());
}

}  // namespace thing_kin
