#pragma once

#include <cstddef>

namespace thing_kin {

/// Whether no number is NaN or infinite.
bool all_finite(const double* numbers, std::size_t count) noexcept;

}  // namespace thing_kin
