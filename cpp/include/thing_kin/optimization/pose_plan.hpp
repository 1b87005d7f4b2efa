#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "thing_kin/core/low_discrepancy.hpp"
#include "thing_kin/inverse/closed_form_ik.hpp"
#include "thing_kin/inverse/joint_box.hpp"
#include "thing_kin/inverse/reach.hpp"
#include "thing_kin/kinematics/clearance.hpp"
#include "thing_kin/optimization/solve_status.hpp"

namespace thing_kin {

/// Problem (4.34) of [M17] but for its target: minimize sqrt(kappa/M) over the configurations that
/// have the frame at the target, the base within a disc about its goal and a window of heading, the
/// joints within limits, and all clearances kept.
struct PosePlanOptions {
  std::optional<Eigen::Vector2d> base_goal;      ///< m
  double base_radius = 0.0;                      ///< m, about base_goal
  std::optional<std::array<double, 2>> heading;  ///< rad, taken as given
  JointVector column_weights;  ///< of the Jacobian whose dexterity counts, (n); empty: ones
  bool global = false;         ///< the best of all, not the next to the seed
  int max_iterations = 60;     ///< of one descent
  int max_restarts = 100;      ///< of a local search, where the seed's descent fails
  int samples = 128;           ///< of a global search: base placements
  int descents = 32;           ///< of a global search: from the best of the samples
  double tolerance = 1e-8;     ///< m and rad: a constraint violated by less is kept
  std::uint64_t rng = 0;       ///< which samples are tried

  /// Throws InvalidArgument if something does not fit the chain.
  void check(const Chain& chain) const;
};

/// What a PosePlanner found. q is finite and within joint limits, also without success.
struct PosePlan {
  JointVector q;
  SolveStatus status = SolveStatus::kInfeasible;
  double objective = 0.0;             ///< sqrt(kappa/M), [M17] (4.33)
  double constraint_violation = 0.0;  ///< the largest of all, m or rad
  double position_error = 0.0;        ///< m
  double rotation_error = 0.0;        ///< rad
  int worst = 0;                      ///< which constraint is violated most, see describe()
  int iterations = 0;                 ///< of all descents
  int restarts = 0;
  double time = 0.0;  ///< s

  bool success() const { return status == SolveStatus::kConverged; }
};

/// Finds the whole-body pose of problem (4.34). The pose's six equations are eliminated: each step
/// is one in the null space of the Jacobian, of a quadratic program with the exact second
/// derivatives of log sqrt(kappa/M), of the pose and of the clearances, in a trust region; then the
/// hand is brought back by inverse kinematics. Where the seed's descent fails, others begin at
/// solutions of inverse kinematics for base placements within the disc.
///
/// Every answer is checked by forward kinematics. Immutable: any number of threads may share one.
/// The result depends on target, seed and options alone.
class PosePlanner {
 public:
  /// Refers to `chain`, which must outlive it. Throws InvalidArgument for what does not fit it.
  PosePlanner(const Chain& chain, int frame, PosePlanOptions options, const LinkSpheres& spheres,
              std::vector<Obstacle> obstacles);
  PosePlanner(Chain&&, int, PosePlanOptions, const LinkSpheres&, std::vector<Obstacle>) = delete;

  const Chain& chain() const { return chain_; }
  int frame() const { return frame_; }
  const PosePlanOptions& options() const { return options_; }

  /// seed: (n); numbers up to 1e50.
  PosePlan solve(const SE3& target, const double* seed) const;

  /// The constraint that PosePlan::worst names: "the hand's position", "the base's distance from
  /// its goal", "sphere 3 (forearm) and obstacle 0".
  std::string describe(int constraint) const;

  /// How many constraints there are, and by how much q violates one, m or rad.
  int constraints() const;
  double violation(int i, const JointVector& q, double position_error,
                   double rotation_error) const noexcept;

  /// sqrt(kappa/M) at q, [M17] (4.33).
  double objective(const JointVector& q) const noexcept;

 private:
  friend class PoseSearch;   // one solve
  friend class PoseDescent;  // one descent
  friend class PoseStarts;   // where descents begin

  PosePlan refuse(const SE3& target, const double* seed) const;
  bool is_base_clear(const Eigen::Vector2d& base) const noexcept;

  const Chain& chain_;
  int frame_;
  PosePlanOptions options_;
  JointBox box_;  // limits, heading, and the square about the base's disc
  Reach reach_;
  std::vector<Disc> discs_;
  Clearances clearances_;
  std::optional<ClosedFormIk> closed_form_;
  LowDiscrepancy sequence_;
  int crossed_ = -1;  // a joint without any place
};

/// In a sentence: "converged", "infeasible: the hand's position is off by 0.3 m".
std::string message(const PosePlanner& planner, const PosePlan& plan);

}  // namespace thing_kin
