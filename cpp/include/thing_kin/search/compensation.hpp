#pragma once

#include <vector>

#include "thing_kin/search/spiral.hpp"

namespace thing_kin {

/// points[k] + velocity times[k], [X21] (2.2) with the time that has passed since the first point
/// was meant (the thesis prints the time since the point before). `times` in s, one for each point.
SearchPoints compensated_points(const SearchPoints& points, const Eigen::Vector2d& velocity,
                                const std::vector<double>& times);

}  // namespace thing_kin
