#pragma once

#include <array>

#include "thing_kin/linalg/svd.hpp"

namespace thing_kin {

/// How a task's rows fall into the blocks whose norms Buss & Kim take as end effectors: a pose has
/// two, its linear and its angular part; any other task is one.
struct RowBlocks {
  std::array<int, kMaxTaskRows> size{};
  int count = 0;

  static RowBlocks whole(int rows) { return {{rows}, 1}; }
  static RowBlocks pose() { return {{3, 3}, 2}; }
};

/// Scales v so that its largest absolute entry is at most `bound`.
void clamp_max_abs(JointVector& v, double bound) noexcept;

/// The selectively damped least-squares step of Buss & Kim (2005) for A dq = e, [M17] (4.11).
///
/// `svd` decomposes A, after any filter; its singular values beyond the rank are skipped. No entry
/// of the step exceeds gamma_max (rad, and metres for a prismatic joint).
JointVector selectively_damped_step(const Svd& svd, const RowBlocks& blocks, const SmallVector& e,
                                    double gamma_max) noexcept;

}  // namespace thing_kin
