#pragma once

#include <cstddef>
#include <limits>

#include "thing_kin/core/low_discrepancy.hpp"
#include "thing_kin/inverse/closed_form_ik.hpp"
#include "thing_kin/inverse/ik_result.hpp"
#include "thing_kin/inverse/joint_box.hpp"
#include "thing_kin/inverse/pose_residual.hpp"
#include "thing_kin/inverse/reach.hpp"

namespace thing_kin {

/// What a solution does with the freedom that the target leaves.
enum class IkObjective : std::uint8_t {
  kNone,
  kSeed,            ///< least weighted square distance from the seed
  kLimits,          ///< least sum of ((q - middle)/range)^2 over the joints with limits
  kManipulability,  ///< greatest M = sqrt(det(J J^T)), [M17] (4.30)
};

IkObjective ik_objective_from_string(const std::string& name);
const char* to_string(IkObjective objective);

struct IkOptions {
  double position_tolerance = 1e-7;  ///< m
  double rotation_tolerance = 1e-7;  ///< rad
  PoseWeights weights;
  JointVector joint_weights;  ///< cost of each joint's motion, [1e-6, 1e6]; empty: 1
  JointVector max_step;       ///< how far each joint may be from the seed; empty: anywhere
  IkObjective objective = IkObjective::kNone;
  bool nearest = false;        ///< search on for the solution nearest to the seed
  int max_iterations = 12000;  ///< of all attempts together
  int max_restarts = 400;
  double deadline = std::numeric_limits<double>::infinity();  ///< s
  std::uint64_t rng = 0;                                      ///< which restarts are tried
  bool closed_form = true;  ///< restart from the closed form's solutions, where there is one

  /// Throws InvalidArgument if something does not fit the chain.
  void check(const Chain& chain) const;
};

/// Many targets; seeds null, one for all, or one a target.
struct IkBatch {
  const SE3* targets = nullptr;
  const double* seeds = nullptr;
  bool one_seed = true;
  std::size_t count = 0;
  int threads = 0;  ///< 0: as many as pay
};

/// One array a field of IkResult; a row a target, active_limits and q have a column a joint.
struct IkBatchResult {
  double* q;
  std::uint8_t* status;
  double* position_error;
  double* rotation_error;
  std::int8_t* active_limits;
  std::int32_t* iterations;
  std::int32_t* restarts;
  double* time;
};

/// Inverse kinematics of any chain: a damped Gauss-Newton descent (Levenberg-Marquardt with the
/// damping in proportion to the cost, Sugihara 2011) on the exact Jacobian of the log error, that
/// never leaves the joint limits; given up early where it stalls, and begun anew from the best of a
/// few low-discrepancy samples, or for an arm on its own that has one from the solutions of its
/// closed form. Every answer is checked by forward kinematics.
///
/// Immutable: any number of threads may share one. solve() allocates nothing, and its result is a
/// function of target, seed and options alone.
class NumericIk {
 public:
  /// Refers to `chain`, which must outlive it. Throws InvalidArgument for bad options.
  NumericIk(const Chain& chain, int frame, IkOptions options = {});
  NumericIk(Chain&&, int, IkOptions = {}) = delete;

  const Chain& chain() const { return chain_; }
  int frame() const { return frame_; }
  const IkOptions& options() const { return options_; }

  /// target, seed: numbers up to 1e50, lest their squares overflow. The target's rotation is made
  /// orthonormal first. seed: (n), brought into the limits first; or null: none, which max_step,
  /// nearest and the objective kSeed do not allow.
  IkResult solve(const SE3& target, const double* seed) const noexcept;

  /// Each row as by solve(), on several threads.
  void solve(const IkBatch& batch, const IkBatchResult& results) const;

 private:
  friend class IkSearch;  // one solve

  const Chain& chain_;
  int frame_;
  IkOptions options_;
  JointVector mobility_;  // inverse joint weights
  JointBox box_;
  Reach reach_;
  double length_;  // that counts as one radian, m
  LowDiscrepancy samples_;
  std::optional<ClosedFormIk> closed_form_;
};

}  // namespace thing_kin
