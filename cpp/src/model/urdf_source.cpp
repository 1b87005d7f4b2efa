#include "thing_kin/model/urdf_source.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vector>

#include "thing_kin/core/error.hpp"
#include "thing_kin/model/urdf_document.hpp"

namespace thing_kin {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> folders_in(const char* variable) {
  std::vector<fs::path> folders;
  const char* value = std::getenv(variable);
  std::istringstream list(value == nullptr ? "" : value);
  for (std::string folder; std::getline(list, folder, ':');) {
    if (!folder.empty()) {
      folders.emplace_back(folder);
    }
  }
  return folders;
}

// Every place where the package may be, the most particular first.
std::vector<fs::path> candidates(const std::string& package, const PackageFolders& packages) {
  const auto given = packages.find(package);
  if (given != packages.end()) {
    return {given->second};
  }
  std::vector<fs::path> folders;
  for (const fs::path& folder : folders_in("ROS_PACKAGE_PATH")) {
    folders.push_back(folder / package);
    const fs::path plain = folder.has_filename() ? folder : folder.parent_path();
    if (plain.filename() == package) {
      folders.push_back(plain);
    }
  }
  for (const fs::path& prefix : folders_in("AMENT_PREFIX_PATH")) {
    folders.push_back(prefix / "share" / package);
  }
  return folders;
}

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw InvalidArgument("source", quoted(path.string()).append(", ").append(why),
                        "a URDF file, or its text");
}

}  // namespace

fs::path resolve_urdf_path(const std::string& path, const PackageFolders& packages) {
  constexpr std::string_view kPackage = "package://";
  constexpr std::string_view kFile = "file://";
  if (path.starts_with(kFile)) {
    return path.substr(kFile.size());
  }
  if (!path.starts_with(kPackage)) {
    return path;
  }
  const std::string rest = path.substr(kPackage.size());
  const std::string package = rest.substr(0, rest.find('/'));
  const std::string file = rest.substr(std::min(rest.size(), package.size() + 1));
  for (const fs::path& folder : candidates(package, packages)) {
    std::error_code ignored;
    if (fs::exists(folder / file, ignored)) {
      return folder / file;
    }
  }
  throw InvalidArgument("source", quoted(path),
                        std::string("a file of a package that `packages`, ROS_PACKAGE_PATH or "
                                    "AMENT_PREFIX_PATH leads to"));
}

std::string read_urdf_file(const fs::path& path) {
  std::error_code error;
  if (path.empty() || path.native().find('\0') != std::string::npos) {
    refuse("", "which is no path");
  }
  if (path.extension() == ".xacro") {
    refuse(path, "which xacro has to expand first ('xacro robot.urdf.xacro > robot.urdf')");
  }
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    refuse(path, "which is not there");
  }
  if (!fs::is_regular_file(status)) {  // reading a pipe might wait for ever
    refuse(path, "which is no regular file");
  }
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > kLargestUrdf) {
    refuse(path, std::string("which has ").append(std::to_string(size)).append(" bytes"));
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (size > 0) {
    text << file.rdbuf();
  }
  if (!file || !text) {
    refuse(path, "which can't be read");
  }
  return std::move(text).str();
}

}  // namespace thing_kin
