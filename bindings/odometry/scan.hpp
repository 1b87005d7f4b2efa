#pragma once

#include <vector>

#include "array.hpp"
#include "thing_kin/odometry/planar_motion.hpp"
#include "thing_kin/odometry/scan.hpp"

namespace thing_kin::python {

/// One range for each beam; inf and NaN are no returns. Throws InvalidArgument naming `name`.
std::vector<double> read_ranges(const Scanner& scanner, const ArrayLike& ranges, const char* name);

/// Three moderate numbers.
Eigen::Vector3d read_planar(py::handle argument, const char* name);

/// (3, 3), symmetric and positive semidefinite.
Eigen::Matrix3d read_planar_covariance(py::handle argument, const char* name);

}  // namespace thing_kin::python
