#pragma once

#include "thing_kin/estimation/gaussian_filter.hpp"

namespace thing_kin {

/// Throw InvalidArgument(name, ...) for a wrong size, NaN or infinity.
void check_matrix(const ModelMatrix& A, Eigen::Index rows, Eigen::Index cols, const char* name);
void check_square(const StateMatrix& A, Eigen::Index n, const char* name);
void check_vector(const StateVector& v, Eigen::Index size, const char* name);

/// A measurement has 1 to kMaxState entries.
void check_measurement(const StateVector& z);

}  // namespace thing_kin
