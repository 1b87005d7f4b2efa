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
  const auto compute = [&](const SkeletonFrame& frame) {
    kernels().jacobian(chain.skeleton(), frame, posture.columns, reference, J.data());
  };
  if (of.point.isZero(0.0)) {
    compute(chain.skeleton_frame(of.frame));
  } else {
    compute(skeleton_frame_at(chain, of));
  }
}

}  // namespace thing_kin
