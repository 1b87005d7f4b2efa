#pragma once

#include <string>

#include <Eigen/Core>

#include "thing_kin/core/types.hpp"

namespace thing_kin {

/// A vector function of the variables with exact first and second derivatives: what a Problem's
/// objectives and constraints are made of. Immutable: any number of threads may share one, unless
/// it calls back into Python.
class Term {
 public:
  Term() = default;
  Term(const Term&) = default;
  Term& operator=(const Term&) = default;
  Term(Term&&) = default;
  Term& operator=(Term&&) = default;
  virtual ~Term() = default;

  /// For messages and traces: "pose", "base_distance".
  virtual std::string name() const = 0;

  /// What one of its numbers is about, in words: "sphere 2 (forearm) and obstacle 0"; else empty.
  virtual std::string describe(int /*entry*/) const { return {}; }

  /// How many numbers it gives.
  virtual int size() const = 0;

  /// How many variables it takes; 0: any number.
  virtual int variables() const = 0;

  /// value: size() entries; J: (size(), n), d value/dx, or null. False where the function or its
  /// derivative does not exist (a singular posture, for the condition number): then value and J are
  /// undefined.
  virtual bool evaluate(const VectorView& x, Eigen::Ref<Eigen::VectorXd> value,
                        Eigen::MatrixXd* J) const = 0;

  /// H += sum_i weights_i d^2 value_i/dx^2, at an x where evaluate() was true.
  virtual void add_hessian(const VectorView& x, const VectorView& weights,
                           Eigen::MatrixXd& H) const = 0;
};

}  // namespace thing_kin
