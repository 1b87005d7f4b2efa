#pragma once

#include <memory>
#include <string>

#include "thing_kin/model/chain.hpp"
#include "thing_kin/optimization/term.hpp"

namespace thing_kin {

/// What a term is to compute, said before it is known of which robot: tk.terms.Pose(T_goal).
/// A Problem binds it to its robot and gets the Term. Immutable.
class TermRecipe {
 public:
  TermRecipe() = default;
  TermRecipe(const TermRecipe&) = default;
  TermRecipe& operator=(const TermRecipe&) = default;
  TermRecipe(TermRecipe&&) = default;
  TermRecipe& operator=(TermRecipe&&) = default;
  virtual ~TermRecipe() = default;

  /// As the term's: "pose", "base_distance".
  virtual std::string name() const = 0;

  /// The term of this robot, which it keeps alive; null: a problem without a robot. Throws
  /// InvalidArgument("robot", ...) where one is needed and missing or does not fit.
  virtual std::shared_ptr<const Term> bind(const std::shared_ptr<const Chain>& robot) const = 0;
};

}  // namespace thing_kin
