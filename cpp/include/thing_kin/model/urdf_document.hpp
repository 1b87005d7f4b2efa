#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace thing_kin {

/// Of a text or a file, in bytes; the largest robots have one or two million.
inline constexpr std::size_t kLargestUrdf = 64U << 20U;

/// A <joint> as written: its own attributes and those of the elements in it that matter here.
struct UrdfJoint {
  using Attributes = std::map<std::string, std::string>;

  std::string name;
  std::string type;
  std::string parent;
  std::string child;
  std::map<std::string, Attributes> elements;  ///< origin, axis, limit, mimic, where there
};

/// What kinematics needs of a URDF, as strings; nothing is interpreted yet.
struct UrdfDocument {
  UrdfJoint::Attributes robot;
  std::vector<std::string> links;
  std::vector<UrdfJoint> joints;
};

/// Parses XML with Expat, which does not recurse, and keeps nothing of meshes, inertias and the
/// like. `is_utf8`: whatever the XML declaration says. Throws InvalidArgument for what is not
/// well-formed, is no <robot>, is not expanded xacro, has a document type (and so entities), is
/// larger than kLargestUrdf or nested deeper than 100.
UrdfDocument read_urdf_document(std::string_view xml, bool is_utf8);

}  // namespace thing_kin
