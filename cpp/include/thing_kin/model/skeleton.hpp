#pragma once

// Plain numbers only: the kernels that read it are compiled for several instruction sets and must
// share no inline function with the rest of the library.

#include "thing_kin/core/max_dof.hpp"

namespace thing_kin {

/// A constant turn: right angles need no multiplication.
enum class Turn : unsigned char { kNone, kQuarter, kMinusQuarter, kGeneral };

/// A chain as the kernels see it. Every constant transform between two axes is Rz Tr(offset) Rx Rz;
/// the turns about z commute with the joints next to them and merge into them, so that a pose is
///
///     start  Rz(turn_0 + q_0)  Tr(offset_1) Rx(tilt_1)  Rz(turn_1 + q_1)  ...
///
/// with Tz(q) beside Rz(turn) for a prismatic joint. Right angles are exact, and nothing is lost
/// where axes are nearly parallel (there the common normal of Denavit and Hartenberg is).
struct Skeleton {
  struct Step {
    double offset[3] = {0, 0, 0};
    double cos_tilt = 1.0;
    double sin_tilt = 0.0;
    Turn tilt = Turn::kNone;
    Turn turn = Turn::kNone;
    bool shifts[3] = {false, false, false};  ///< which of the offset are not zero
    bool prismatic = false;
    int index = 0;  ///< of the joint in q
  };

  int joints = 0;
  double start[16] = {};  ///< columns x, y, z, origin, each padded by a zero
  Step step[kMaxDof];
  double cos_turn[kMaxDof] = {};
  double sin_turn[kMaxDof] = {};
};

/// A frame as the kernels see it: `offset` (columns x, y, z, origin, padded) from joint
/// `joints - 1` after its motion, or from the root.
struct SkeletonFrame {
  int joints = 0;
  bool turned = true;  ///< the offset is more than a shift
  double offset[16] = {};
};

}  // namespace thing_kin
