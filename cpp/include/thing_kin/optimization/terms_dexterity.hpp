#pragma once

#include <string>
#include <variant>

#include "thing_kin/optimization/term_recipe.hpp"

namespace thing_kin::terms {

/// The columns of the Jacobian that a measure of dexterity counts.
struct WholeBody {};
struct Arm {};  ///< all but the base's
/// All, each times its joint's weight, (n), 0 to 1e6.
using ColumnWeights = Eigen::VectorXd;
using Columns = std::variant<WholeBody, Arm, ColumnWeights>;

/// The whole-body Jacobian is blind to singularities of the arm, whose lost direction the base's
/// columns fill: count the arm's where that matters.
class DexterityMeasure : public TermRecipe {
 public:
  std::shared_ptr<const Term> bind(const std::shared_ptr<const Chain>& robot) const override;

  const Columns& columns() const { return columns_; }
  const std::string& frame() const { return frame_; }

 protected:
  /// f = exp(sign (w_kappa log kappa - w_M log M)).
  struct Kind {
    const char* name;
    double condition_number;  ///< w_kappa
    double manipulability;    ///< w_M
    double sign;
  };

  DexterityMeasure(Kind kind, Columns columns, std::string frame);

 private:
  class Bound;

  Kind kind_;
  Columns columns_;
  std::string frame_;
};

/// M = sqrt(det(J J^T)), [M17] (4.30). Where the rank is lost: zero, with derivatives of zero.
class Manipulability : public DexterityMeasure {
 public:
  explicit Manipulability(Columns columns = WholeBody{}, std::string frame = "");
  std::string name() const override { return "manipulability"; }
};

/// kappa = sigma_max/sigma_min, [M17] (4.32). Does not exist where the rank is lost.
class ConditionNumber : public DexterityMeasure {
 public:
  explicit ConditionNumber(Columns columns = WholeBody{}, std::string frame = "");
  std::string name() const override { return "condition_number"; }
};

/// sqrt(kappa/M), [M17] (4.33). Does not exist where the rank is lost.
class Dexterity : public DexterityMeasure {
 public:
  explicit Dexterity(Columns columns = WholeBody{}, std::string frame = "");
  std::string name() const override { return "dexterity"; }
};

}  // namespace thing_kin::terms
