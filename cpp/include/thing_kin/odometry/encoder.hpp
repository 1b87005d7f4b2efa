#pragma once

#include <cstddef>
#include <span>

namespace thing_kin {

/// Undoes the overflow of a counter that goes from its last value back to its first (or the other
/// way round): every step becomes the shortest one that is the same modulo `range`, so that no
/// wheel may turn by range/2 ticks or more between two readings. In place; every `stride`-th
/// number.
void unwrap_ticks(std::span<double> ticks, std::size_t stride, double range) noexcept;

}  // namespace thing_kin
