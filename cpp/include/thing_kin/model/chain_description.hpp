#pragma once

#include <string>
#include <vector>

#include "thing_kin/model/segment.hpp"

namespace thing_kin {

/// What a Chain is made from; a plain value, to be built up and then frozen.
struct ChainDescription {
  std::string name;
  std::string root = "world";  ///< name of the frame that the first segment stands in
  std::vector<Segment> segments;
  std::vector<int> order;      ///< order[i]: index in q of the i-th joint from the root
  bool has_omni_base = false;  ///< the first three joints are x, y, theta of a planar base

  bool operator==(const ChainDescription&) const = default;
};

}  // namespace thing_kin
