#pragma once

#include <string>

#include "thing_kin/optimization/term_recipe.hpp"

namespace thing_kin::terms {

/// ||p_base - center||, m, [M17] (4.29): at most a radius around a goal, at least one around an
/// obstacle. At the center itself, where no derivative exists, that along x is given.
class BaseDistance : public TermRecipe {
 public:
  explicit BaseDistance(const Eigen::Vector2d& center);

  std::string name() const override { return "base_distance"; }
  std::shared_ptr<const Term> bind(const std::shared_ptr<const Chain>& robot) const override;

  const Eigen::Vector2d& center() const { return center_; }

 private:
  Eigen::Vector2d center_;
};

/// target - p_base, m.
class BasePosition : public TermRecipe {
 public:
  explicit BasePosition(const Eigen::Vector2d& target);

  std::string name() const override { return "base_position"; }
  std::shared_ptr<const Term> bind(const std::shared_ptr<const Chain>& robot) const override;

  const Eigen::Vector2d& target() const { return target_; }

 private:
  Eigen::Vector2d target_;
};

}  // namespace thing_kin::terms
