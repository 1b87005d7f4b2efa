#pragma once

#include <vector>

#include "thing_kin/core/types.hpp"

namespace thing_kin {

/// Minimizes |A x - b| where x_j >= 0 unless free[j]: Lawson and Hanson's active set method. The
/// columns may depend on each other.
Eigen::VectorXd signed_least_squares(const MatrixView& A, const VectorView& b,
                                     const std::vector<bool>& free);

}  // namespace thing_kin
