#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "thing_kin/model/omni_base.hpp"

namespace thing_kin::python {

using Ranges = std::optional<std::vector<std::pair<double, double>>>;

/// `limits` with the positions of x, y and theta replaced, if any are given.
BaseLimits with_ranges(BaseLimits limits, const Ranges& ranges);

}  // namespace thing_kin::python
