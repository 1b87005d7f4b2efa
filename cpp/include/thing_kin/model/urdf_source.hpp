#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace thing_kin {

/// Folders of ROS packages by name.
using PackageFolders = std::map<std::string, std::filesystem::path>;

/// The file of package://name/rest in `packages`, else in ROS_PACKAGE_PATH (a package's own folder
/// or the one above), else in AMENT_PREFIX_PATH (prefix/share/name); any other path as it is, but
/// for file://. Throws InvalidArgument if the package is in none of them.
std::filesystem::path resolve_urdf_path(const std::string& path, const PackageFolders& packages);

/// The text of a regular file. Throws InvalidArgument for what can't be read, is larger than
/// kLargestUrdf (model/urdf_document.hpp) or is called *.xacro.
std::string read_urdf_file(const std::filesystem::path& path);

}  // namespace thing_kin
