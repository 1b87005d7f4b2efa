#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "thing_kin/optimization/convex_model.hpp"

namespace thing_kin {

/// Which smooth problems stand for the l1 penalties, and what of Ceres minimizes them.
enum class CeresMethod : std::uint8_t {
  /// Levenberg-Marquardt on the augmented Lagrangian, whose multipliers are kept within the
  /// penalty: the Moreau envelope of the l1 penalty.
  kAugmentedLagrangian,
  /// Levenberg-Marquardt on penalties rounded over a width that shrinks to 1e-9.
  kSmoothed,
  /// BFGS with a line search on the augmented Lagrangian, the box among its constraints.
  kBfgs,
};

/// "augmented_lagrangian", "smoothed", "bfgs"; throws InvalidArgument.
CeresMethod ceres_method_from_string(const std::string& name);

/// [M17] 5.3.2: convex models minimized by Ceres, to 1e-9. Safe for several threads at once.
std::unique_ptr<ConvexMinimizer> make_ceres_minimizer(CeresMethod method);

}  // namespace thing_kin
