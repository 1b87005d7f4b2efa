#pragma once

#include "kernels.hpp"
#include "thing_kin/kinematics/jacobian.hpp"

namespace thing_kin {

/// The reference frame by the kernels' own name.
inline Kernels::Reference to_kernel(ReferenceFrame reference) noexcept {
  switch (reference) {
    case ReferenceFrame::kBody:
      return Kernels::kBody;
    case ReferenceFrame::kWorld:
      return Kernels::kWorld;
    case ReferenceFrame::kWorldAligned:
      break;
  }
  return Kernels::kWorldAligned;
}

}  // namespace thing_kin
