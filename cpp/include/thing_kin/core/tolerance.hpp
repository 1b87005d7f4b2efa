#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace thing_kin {

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Singular values at most this fraction of the largest count as zero: the rounding error of a
/// singular value decomposition of an (m, n) matrix.
inline double rank_tolerance(Eigen::Index rows, Eigen::Index cols) {
  return static_cast<double>(std::max(rows, cols)) * kEpsilon;
}

/// How far R^T R of a given pose may be from the identity: loose enough for matrices printed with
/// seven digits or stored in single precision, tight enough to refuse anything else.
inline constexpr double kRotationTolerance = 1e-6;

/// A quaternion's scalar part below this is a rotation by pi within rounding: there the sign of
/// the axis is noise and is chosen by rule (so3.hpp).
inline constexpr double kHalfTurnTolerance = 8 * kEpsilon;

/// A cosine of the pitch below this is the rounding of a product of some ten rotations: there roll
/// is noise and is chosen by rule (so3.hpp).
inline constexpr double kGimbalLockTolerance = 32 * kEpsilon;

/// tan(angle) of [M17] (3.18) and the rates of roll and yaw, which grow with 1/cos(pitch), are
/// refused this close to their pole at pi/2, rad.
inline constexpr double kQuarterTurnMargin = 1e-9;

/// An angle this close to a whole number of right angles is meant to be one, so that Denavit-
/// Hartenberg rows with pi/2 give exact zeros and ones.
inline constexpr double kRightAngleTolerance = 4 * kEpsilon;

}  // namespace thing_kin
