#pragma once

// Angles are known up to whole turns: which one a joint takes.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace thing_kin::closed_form {

inline constexpr double kTurn = 2.0 * std::numbers::pi;

/// Rounding beyond a limit, rad, which is put onto it.
inline constexpr double kAtLimit = 1e-10;

/// The angle by whole turns nearest to `reference`; both below 2^51 turns.
inline double turned_near(double reference, double angle) noexcept {
  constexpr double kRounder = 0x1.8p52;  // two additions, where std::round is a call
  const double turns = ((reference - angle) * (1.0 / kTurn) + kRounder) - kRounder;
  return angle + kTurn * turns;
}

/// Turns an angle beyond limits to the nearest one inside, and returns 0; or if there is none to
/// the one that is least beyond, and returns by how much.
inline double put_inside(double lower, double upper, double& angle) noexcept {
  const double up = std::max(0.0, std::ceil((lower - kAtLimit - angle) / kTurn));
  const double down = std::max(0.0, std::ceil((angle - upper - kAtLimit) / kTurn));
  const double moved = angle + kTurn * (up - down);
  if (moved >= lower - kAtLimit && moved <= upper + kAtLimit) {
    angle = std::clamp(moved, lower, upper);
    return 0.0;
  }
  const double other = moved + (up > 0.0 ? -kTurn : kTurn);
  const auto beyond = [&](double at) { return std::max(lower - at, at - upper); };
  angle = beyond(other) < beyond(moved) ? other : moved;
  return beyond(angle);
}

}  // namespace thing_kin::closed_form
