#pragma once

#include <string>
#include <string_view>

#include "thing_kin/model/chain.hpp"
#include "thing_kin/model/urdf_source.hpp"

namespace thing_kin {

struct UrdfOptions {
  std::string base;      ///< a link; empty: the root
  std::string tip;       ///< a link; empty: the only leaf below the base
  std::string name;      ///< of the chain; empty: the robot's
  bool is_utf8 = false;  ///< the text, whatever its XML declaration says
};

/// The chain between two links of a URDF, by urdfdom. Its frames are the links, q counts its joints
/// from base to tip; where the way goes up to a common ancestor first, joints there are run through
/// backwards and keep their sign and limits.
///
/// A velocity limit that is absent, zero or negative, and any limit of the largest double, means
/// unlimited; efforts, soft limits, inertias and shapes are not read. Throws InvalidArgument for
/// whatever is wrong with the text, and for a mimic, planar or floating joint on the chain.
Chain from_urdf(std::string_view text, const UrdfOptions& options = {});

/// The same from a file: a path or package://name/rest (see resolve_urdf_path).
Chain from_urdf_file(const std::string& path, const UrdfOptions& options = {},
                     const PackageFolders& packages = {});

}  // namespace thing_kin
