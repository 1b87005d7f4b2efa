#pragma once

#include "thing_kin/core/types.hpp"
#include "thing_kin/kinematics/hessian.hpp"
#include "thing_kin/linalg/svd.hpp"

namespace thing_kin {

/// How well a point can move at one posture: singular values of its Jacobian and measures of them.
/// With fewer than six joints or a lost rank: M = 0, kappa = inf, sqrt(kappa/M) = inf.
class Dexterity {
 public:
  Dexterity(const Chain& chain, const Posture& posture, const MovingPoint& of) noexcept;

  /// M = sqrt(det(J J^T)), [M17] (4.30): the product of the six singular values.
  double manipulability() const noexcept;

  /// kappa = sigma_max/sigma_min, [M17] (4.32).
  double condition_number() const noexcept;

  /// sqrt(kappa/M), [M17] (4.33).
  double dexterity() const noexcept;

  /// The largest and the smallest singular value are simple and not zero, so that kappa and
  /// sqrt(kappa/M) have a gradient here.
  bool has_gradient() const noexcept;

  /// dM/dq, [M17] (4.31) as corrected; zero where the rank is lost.
  JointVector manipulability_gradient(const Hessian& H) const noexcept;

  /// dkappa/dq; has_gradient() must hold.
  JointVector condition_number_gradient(const Hessian& H) const noexcept;

  /// d sqrt(kappa/M)/dq; has_gradient() must hold.
  JointVector dexterity_gradient(const Hessian& H) const noexcept;

  const SmallVector& singular_values() const noexcept { return svd_.sigma; }

 private:
  bool is_singular() const noexcept;
  double singular_value_derivative(const Jacobian& derivative, Eigen::Index i) const noexcept;

  Svd svd_;
};

}  // namespace thing_kin
