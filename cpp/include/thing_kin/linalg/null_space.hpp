#pragma once

#include "thing_kin/linalg/svd.hpp"

namespace thing_kin {

/// Orthonormal basis of the null space of A, (n, n - rank).
SmallMatrix null_space(const SmallMatrix& A) noexcept;

/// The exact orthogonal projector I - A^+ A, (n, n), [M17] (4.15). Built from the null space and
/// not from an inverse, so that it is a projector whatever regularization the inverse has
/// (erratum).
SmallMatrix null_space_projector(const SmallMatrix& A) noexcept;

}  // namespace thing_kin
