#pragma once

#include "thing_kin/model/chain.hpp"

namespace thing_kin {

/// The angle in [-pi, pi) that is `angle` less whole turns, to rounding for any finite angle: the
/// library's sine and cosine reduce by the true pi, not by its double.
double shortest_turn(double angle) noexcept;

/// The way from `from` to `to`, each (n) in the order of q: to - from, with a continuous joint's
/// part in [-pi, pi), the shorter way round. Exact to rounding after thousands of turns too.
void joint_difference(const Chain& chain, const double* from, const double* to,
                      double* difference) noexcept;

}  // namespace thing_kin
