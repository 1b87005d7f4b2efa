#pragma once

namespace thing_kin {

/// Angles of `count` pairs of sine and cosine, of any common length, in [-pi, pi], within about two
/// units in the last place: several at once in the lanes of one instruction.
void arc_tangents(const double* sine, const double* cosine, long count, double* angle) noexcept;

}  // namespace thing_kin
