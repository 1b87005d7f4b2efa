#pragma once

#include "thing_kin/odometry/scan_matching.hpp"

namespace thing_kin::python {

/// As Python says it.
const char* status_name(MatchStatus status);

}  // namespace thing_kin::python
