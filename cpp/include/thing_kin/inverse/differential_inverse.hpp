#pragma once

#include <numbers>
#include <variant>

#include "thing_kin/linalg/selectively_damped.hpp"
#include "thing_kin/linalg/svd.hpp"

namespace thing_kin {

/// How a task's Jacobian is inverted. Each composes with a SingularValueFilter.

/// Moore-Penrose, [M17] (4.6), (4.9).
struct Exact {
  bool operator==(const Exact&) const = default;
};

/// Damped, [M17] (4.7), (4.10).
struct Damped {
  explicit Damped(double lambda);
  double damping;
  bool operator==(const Damped&) const = default;
};

/// Selectively damped, [M17] (4.11), Buss & Kim (2005): no joint moves by more than gamma_max.
struct SelectivelyDamped {
  explicit SelectivelyDamped(double largest_step = std::numbers::pi / 4);
  double gamma_max;
  bool operator==(const SelectivelyDamped&) const = default;
};

using DifferentialInverse = std::variant<Exact, Damped, SelectivelyDamped>;

/// The step dq for A dq = e, where `svd` decomposes A (after any filter).
JointVector apply_inverse(const DifferentialInverse& inverse, const Svd& svd,
                          const RowBlocks& blocks, const SmallVector& e) noexcept;

}  // namespace thing_kin
