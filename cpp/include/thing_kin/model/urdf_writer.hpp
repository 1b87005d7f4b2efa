#pragma once

#include <string>

#include "thing_kin/model/chain.hpp"

namespace thing_kin {

/// The chain as URDF, each number with the digits that give it back. `name`: of the robot; empty:
/// the chain's.
///
/// Each frame becomes a link of its name, from the root outwards; a joint whose frame is off its
/// axis has a further link, '<frame>_joint', between. URDF has no word for some things: q's order
/// becomes the joints' order from the root, acceleration limits and what the base is are left out,
/// a revolute joint without any limit becomes continuous, and inf is written as the largest double,
/// which from_urdf reads as inf.
///
/// Throws InvalidArgument if a name has characters that XML has not.
std::string to_urdf(const Chain& chain, const std::string& name = "");

}  // namespace thing_kin
