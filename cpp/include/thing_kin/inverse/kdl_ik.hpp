#pragma once

#include <cstdint>
#include <limits>

#include "thing_kin/core/low_discrepancy.hpp"
#include "thing_kin/inverse/ik_result.hpp"
#include "thing_kin/inverse/joint_box.hpp"
#include "thing_kin/inverse/reach.hpp"
#include "thing_kin/model/kdl_chain.hpp"

namespace thing_kin {

struct KdlIkOptions {
  double position_tolerance = 1e-7;  ///< m
  double rotation_tolerance = 1e-6;  ///< rad; KDL takes a smaller rotation for none
  int max_iterations = 10000;        ///< of all attempts together
  int max_restarts = 100;
  double deadline = std::numeric_limits<double>::infinity();  ///< s
  std::uint64_t rng = 0;                                      ///< which restarts are tried

  /// Throws InvalidArgument.
  void check(const Chain& chain) const;
};

/// Inverse kinematics of the tool by KDL's Levenberg-Marquardt solver, which knows no limits:
/// joints that end outside are brought back by whole turns, and where that is not enough the search
/// begins anew from a low-discrepancy sample. Every answer is checked by thing_kin's forward
/// kinematics.
///
/// One object serves one thread.
class KdlIk {
 public:
  /// Refers to `chain`, which must outlive it.
  explicit KdlIk(const Chain& chain);
  explicit KdlIk(Chain&&) = delete;

  /// seed: (n) finite, brought into the limits first; or null: none.
  IkResult solve(const SE3& target, const double* seed, const KdlIkOptions& options = {});

 private:
  friend class KdlIkSearch;  // one solve

  const Chain& chain_;
  KdlChain kdl_;
  JointBox box_;
  Reach reach_;
};

}  // namespace thing_kin
