#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "thing_kin/core/types.hpp"
#include "thing_kin/inverse/closed_form_arm.hpp"
#include "thing_kin/lie/se3.hpp"
#include "thing_kin/model/chain.hpp"

namespace thing_kin {

/// Where a solution is at, or within 1e-6 rad of, a place where two branches meet.
enum class ArmSingularity : std::uint8_t { kNone, kShoulder, kElbow, kWrist };

/// "none", "shoulder", "elbow", "wrist".
const char* to_string(ArmSingularity singularity) noexcept;

struct ClosedFormSolution {
  JointVector q;                ///< all joints of the chain, base and all
  double position_error = 0.0;  ///< m, by forward kinematics
  double rotation_error = 0.0;  ///< rad
  bool exact = false;           ///< both errors at most 1e-9
  ArmSingularity singularity = ArmSingularity::kNone;
};

/// What became of a target.
enum class ClosedFormStatus : std::uint8_t {
  kSolved,         ///< at least one exact solution
  kOutsideLimits,  ///< the arm reaches it, but only beyond joint limits
  kUnreachable,    ///< no arm of this shape does: the solutions are the closest poses found
};

struct ClosedFormSolutions {
  static constexpr int kMost = 8;

  int count = 0;
  std::array<ClosedFormSolution, kMost> solutions;
  ClosedFormStatus status = ClosedFormStatus::kUnreachable;
  int outside = 0;          ///< branches left out because of limits
  int limiting_joint = -1;  ///< of the branch that is out least, the joint (in q) that is out most
  double beyond_limit = 0.0;  ///< by how much, rad

  const ClosedFormSolution* begin() const { return solutions.data(); }
  const ClosedFormSolution* end() const { return solutions.data() + count; }
};

struct ClosedFormOptions {
  /// dof() entries. Solutions come nearest first, each joint by the turn nearest to the seed's, and
  /// a joint that is free at a singularity stays at the seed (beyond 1e6 rad it is none). nullptr:
  /// branches in a fixed order, joints nearest to the middle of their range.
  const double* seed = nullptr;
  const double* weights = nullptr;  ///< dof() weights of the distance to the seed; nullptr: ones
  bool respect_limits = true;
  bool closest = true;  ///< look for the closest poses where the target can't be reached
};

/// All configurations of a six-joint arm for a pose, in closed form: arms with axes 2, 3 and 4 (or
/// 3, 4 and 5) parallel, such as those of Universal Robots, and arms with a spherical wrist (or
/// shoulder). The arm may stand on an omnidirectional base.
///
/// Decomposition into subproblems after Paden (1986), Kahan and Murray, Li, Sastry (1994), and
/// Elias and Wen (2022); the unknown angles stay cosines and sines until the end. Immutable: any
/// number of threads may use one object. Refers to the chain, which must outlive it.
class ClosedFormIk {
 public:
  /// Directions (rad) and distances (by the arm's length) that differ by less count as equal;
  /// solutions are then polished on the arm as it is. URDF files round to about 1e-9.
  static constexpr double kGeometryTolerance = 1e-6;

  /// Nothing if the chain up to the frame has no closed form here; decided by its axes alone.
  static std::optional<ClosedFormIk> find(const Chain& chain, int frame) noexcept;

  /// Why find() finds nothing; empty if it finds something.
  static std::string obstacle(const Chain& chain, int frame);

  /// `base`: x, y and theta of the base (needed on a base, else ignored). Rounding in the target's
  /// rotation is removed first.
  void solve(const SE3& target, const double* base, ClosedFormSolutions& out,
             const ClosedFormOptions& options = {}) const noexcept;

  /// The solutions with every image of them, by whole turns of a joint with limits, that is within
  /// limits; in the order of solve(). A joint without limits keeps its turn. Allocates; throws
  /// InvalidArgument for more than kMostImages.
  std::vector<ClosedFormSolution> with_images(const SE3& target,
                                              const ClosedFormSolutions& solutions,
                                              const ClosedFormOptions& options = {}) const;
  static constexpr std::size_t kMostImages = 100'000;

  const Chain& chain() const { return *chain_; }
  int frame() const { return frame_; }

 private:
  ClosedFormIk() = default;

  friend struct ClosedFormBuilder;
  friend class ClosedFormRun;

  const Chain* chain_ = nullptr;
  int frame_ = 0;
  double length_ = 1.0;         ///< of the arm, m
  std::array<int, 6> joint_{};  ///< of the canonical arm: index in q
  std::array<closed_form::JointAngle, 6> angle_;
  std::array<double, 6> lower_{}, upper_{}, middle_{};
  bool reversed_ = false;  ///< solved from the tool towards the root
  bool on_base_ = false;
  closed_form::PlanarBase base_;
  SE3 before_, after_;  ///< canonical target = before_ * target from the base * after_
  std::variant<closed_form::ParallelArm, closed_form::SphericalArm> arm_;
};

}  // namespace thing_kin
