#pragma once

#include <array>
#include <vector>

#include "thing_kin/core/types.hpp"
#include "thing_kin/linalg/convex_qp.hpp"

namespace thing_kin {

/// The quadratic program of a step among the configurations that have the hand at the target:
/// min 1/2 z H z + g z over z in the null space of J, where each joint stays between its sides and
/// the inequalities that may come into play hold. The multipliers of one step are known in the
/// next.
class PoseProgram {
 public:
  /// For robots of so many joints; of `slacks` inequalities at most.
  PoseProgram(int joints, int slacks);

  /// Forgets the multipliers of the step before.
  void begin() noexcept;

  /// A new program: joint j moves by row j of Z times z. Its sides are to be set by bound().
  void reset(const SmallMatrix& Z, const SmallMatrix& H, const SmallVector& g) noexcept;
  void bound(Eigen::Index joint, double lower, double upper) noexcept;

  /// Inequality i: slack + along . (Z z) >= 0. `along` is in the space of joints.
  void add(int i, double slack, const SmallMatrix& Z, const JointVector& along) noexcept;

  /// Minimizes the program, made convex if it is not; where no step keeps all inequalities they may
  /// fall short, at a price. False: there is no minimum.
  bool minimize() noexcept;

  const SmallVector& z() const noexcept { return z_; }

  /// H served as it was given.
  bool is_exact() const noexcept { return exact_; }

  /// What the program says that the objective falls by.
  double gain() const noexcept { return -(g_.dot(z_) + 0.5 * z_.dot(H_ * z_)); }

  /// The sum of what the inequalities still fall short by, to first order.
  double violation() const noexcept;

  /// Multipliers: of all inequalities, and of the joints' sides (negative at the upper one).
  const Eigen::VectorXd& of_inequalities() const noexcept { return mu_; }
  const JointVector& of_sides() const noexcept { return nu_; }

  /// The price of violation in a merit: over the multipliers.
  double penalty() const noexcept { return penalty_; }

 private:
  bool stiffen(const FormsView& forms) noexcept;
  void convexify() noexcept;
  bool relax() noexcept;
  void remember_multipliers() noexcept;
  Eigen::Index count() const noexcept {
    return joints_ + static_cast<Eigen::Index>(inequalities_.size());
  }

  Eigen::Index joints_;
  SmallMatrix H_;
  SmallVector g_, z_;
  bool exact_ = true;
  ConvexQp qp_;
  Eigen::MatrixXd forms_;  // of the joints, then of the inequalities
  Eigen::VectorXd lower_, upper_;
  std::vector<int> inequalities_;  // of forms beyond the joints': which
  std::array<int, kMaxDof> stiffened_;
  Eigen::VectorXd mu_;
  JointVector nu_;
  double penalty_ = 0.0;
};

}  // namespace thing_kin
