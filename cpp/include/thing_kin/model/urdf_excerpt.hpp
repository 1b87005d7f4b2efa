#pragma once

#include <string>
#include <vector>

#include "thing_kin/model/urdf_document.hpp"

namespace thing_kin {

/// The joints and links of `joints` alone, written anew for a reader that should not meet what a
/// stranger wrote: origin, axis and limit, every number one by its characters.
/// Throws InvalidArgument, naming the joint, for what should be a number and is not.
std::string write_urdf_excerpt(const UrdfDocument& document,
                               const std::vector<const UrdfJoint*>& joints);

}  // namespace thing_kin
