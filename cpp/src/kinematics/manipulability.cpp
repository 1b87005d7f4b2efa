#include "thing_kin/kinematics/manipulability.hpp"

#include <cmath>

#include "thing_kin/core/tolerance.hpp"

namespace thing_kin {

Dexterity::Dexterity(const Chain& chain, const Posture& posture, const MovingPoint& of) noexcept {
  Jacobian J;
  geometric_jacobian(chain, posture, of, ReferenceFrame::kWorldAligned, J);
  decompose(J, svd_);
}

bool Dexterity::is_singular() const noexcept { return svd_.rank < 6; }

double Dexterity::manipulability() const noexcept {
  return is_singular() ? 0.0 : svd_.sigma.prod();
}

double Dexterity::condition_number() const noexcept {
  return is_singular() ? kInfinity : svd_.sigma[0] / svd_.sigma[5];
}

double Dexterity::dexterity() const noexcept {
  return is_singular() ? kInfinity : std::sqrt(condition_number() / manipulability());
}

bool Dexterity::has_gradient() const noexcept {
  const double gap = rank_tolerance(6, svd_.v.rows()) * (is_singular() ? 0.0 : svd_.sigma[0]);
  return !is_singular() && svd_.sigma[0] - svd_.sigma[1] > gap &&
         svd_.sigma[4] - svd_.sigma[5] > gap;
}

// dsigma_i = u_i^T dJ v_i.
double Dexterity::singular_value_derivative(const Jacobian& derivative,
                                            Eigen::Index i) const noexcept {
  const JointVector turned = derivative.transpose() * svd_.u.col(i);
  return turned.dot(svd_.v.col(i));
}

// M tr((J J^T)^-1 dJ J^T) = sum_i (prod_{j != i} sigma_j) u_i^T dJ v_i, without the inverse.
JointVector Dexterity::manipulability_gradient(const Hessian& H) const noexcept {
  JointVector gradient = JointVector::Zero(svd_.v.rows());
  if (is_singular()) {
    return gradient;
  }
  const double M = manipulability();
  for (Eigen::Index k = 0; k < gradient.size(); ++k) {
    for (Eigen::Index i = 0; i < 6; ++i) {
      const double derivative = singular_value_derivative(H[static_cast<std::size_t>(k)], i);
      gradient[k] += M / svd_.sigma[i] * derivative;
    }
  }
  return gradient;
}

JointVector Dexterity::condition_number_gradient(const Hessian& H) const noexcept {
  JointVector gradient(svd_.v.rows());
  const double kappa = condition_number();
  for (Eigen::Index k = 0; k < gradient.size(); ++k) {
    const Jacobian& Hk = H[static_cast<std::size_t>(k)];
    gradient[k] = kappa * (singular_value_derivative(Hk, 0) / svd_.sigma[0] -
                           singular_value_derivative(Hk, 5) / svd_.sigma[5]);
  }
  return gradient;
}

JointVector Dexterity::dexterity_gradient(const Hessian& H) const noexcept {
  const JointVector of_kappa = condition_number_gradient(H) / condition_number();
  const JointVector of_M = manipulability_gradient(H) / manipulability();
  return 0.5 * dexterity() * (of_kappa - of_M);
}

}  // namespace thing_kin
