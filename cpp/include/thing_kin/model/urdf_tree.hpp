#pragma once

#include <string>
#include <vector>

#include "thing_kin/model/urdf_document.hpp"

namespace thing_kin {

/// A joint on the way from base to tip; `upwards`: from its child to its parent.
struct UrdfStep {
  const UrdfJoint* joint = nullptr;
  bool upwards = false;
};

/// The way between two links of the tree.
struct UrdfPath {
  std::string base;
  std::string tip;
  std::vector<UrdfStep> steps;
};

/// Throws InvalidArgument unless links and joints are a tree: unique names, known links, one root,
/// no cycle, one parent each. `base`: empty for the root; `tip`: empty for the only leaf below
/// the base. The steps point into `document`.
UrdfPath find_urdf_path(const UrdfDocument& document, const std::string& base,
                        const std::string& tip);

}  // namespace thing_kin
