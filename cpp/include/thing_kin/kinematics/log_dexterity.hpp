#pragma once

#include "thing_kin/core/types.hpp"
#include "thing_kin/kinematics/posture.hpp"

namespace thing_kin {

/// log sqrt(kappa/M) of a frame's origin, [M17] (4.33), with exact first and second derivatives:
/// it has the minimizers of sqrt(kappa/M) and is far tamer. Its Jacobian's columns may be weighed:
/// ones are the whole body, zeros leave joints out (the base's: the arm alone).
struct LogDexterity {
  double value;  ///< infinite where the (weighed) Jacobian has lost rank
  JointVector gradient;
  SmallMatrix hessian;

  double condition_number;  ///< kappa, [M17] (4.32)
  double manipulability;    ///< M, [M17] (4.30)
};

/// The value alone; column_weights: (n), at least 0, or null for ones.
double log_dexterity(const Chain& chain, const Posture& posture, int frame,
                     const double* column_weights) noexcept;

/// All of it. False, with an infinite value and derivatives undefined, where the rank is lost.
/// Where the largest or smallest singular value is not simple the derivatives do not exist: those
/// of a function next to it are given.
bool log_dexterity(const Chain& chain, const Posture& posture, int frame,
                   const double* column_weights, LogDexterity& out) noexcept;

}  // namespace thing_kin
