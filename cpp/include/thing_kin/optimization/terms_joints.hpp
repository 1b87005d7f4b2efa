#pragma once

#include <string>

#include "thing_kin/optimization/term_recipe.hpp"

namespace thing_kin::terms {

/// sum_i w_i (q_i - seed_i)^2, [M17] (4.25); continuous joints by the shorter way round. Also for a
/// problem without a robot.
class SeedDistance : public TermRecipe {
 public:
  /// weights: (n), at least 0; empty: ones. Throws InvalidArgument where they don't fit the seed or
  /// are negative, or a number is not finite.
  explicit SeedDistance(Eigen::VectorXd seed, Eigen::VectorXd weights = {});

  std::string name() const override { return "seed_distance"; }
  std::shared_ptr<const Term> bind(const std::shared_ptr<const Chain>& robot) const override;

  const Eigen::VectorXd& seed() const { return seed_; }
  const Eigen::VectorXd& weights() const { return weights_; }

 private:
  Eigen::VectorXd seed_;
  Eigen::VectorXd weights_;
};

/// sum_i ((q_i - middle_i)/range_i)^2 over the joints with two limits: 1/4 of a joint at a limit.
class JointCentering : public TermRecipe {
 public:
  std::string name() const override { return "joint_centering"; }
  std::shared_ptr<const Term> bind(const std::shared_ptr<const Chain>& robot) const override;
};

}  // namespace thing_kin::terms
