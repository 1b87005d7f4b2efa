#pragma once

#include <vector>

#include "map.hpp"
#include "thing_kin/odometry/planar_motion.hpp"

namespace thing_kin::python {

/// Poses along a record with their covariances, as numpy has them.
struct DeadReckoning {
  Array poses;
  Array covariances;
};

/// Throws InvalidArgument unless those that are no single item are equally many.
void check_counts(const Batch& first, const char* first_name, const Batch& second,
                  const char* second_name);

/// One vector or several, none so large that a product overflows.
Batch read_moderate(const ArrayLike& argument, const char* name, py::ssize_t size);

/// A (3, 3) covariance, or zero (for None) or `fallback`.
Eigen::Matrix3d read_planar_covariance(const OptionalArray& argument, const char* name,
                                       const Eigen::Matrix3d& fallback);

/// Shape of what numpy makes of an argument; throws InvalidArgument if it can make nothing.
std::vector<py::ssize_t> shape_of_any(const ArrayLike& argument, const char* name);

/// The start of a record: `pose` and `covariance`.
PlanarEstimate read_start(const ArrayLike& pose, const OptionalArray& covariance);

/// Stamps of N rows that don't decrease.
Batch read_stamps(const ArrayLike& t, py::ssize_t rows);

/// How a wheel's motions get their covariance: from the twist's or from a variance for each metre.
struct WheelNoise {
  const OptionalArray& twist_covariance;
  const OptionalArray& slip_variance;
};

/// Runs dead reckoning without the GIL; `motions` carry dt in `noise` and the way in `travel`.
struct WheelRow {
  Twist2 xi;
  double dt;
  double travel;
};
DeadReckoning reckon(const PlanarEstimate& start, const std::vector<WheelRow>& rows,
                     const WheelNoise& noise);

}  // namespace thing_kin::python
