#pragma once

#include <functional>
#include <string>

#include "thing_kin/optimization/term.hpp"

namespace thing_kin {

/// A term of the user's own functions.
class FunctionTerm : public Term {
 public:
  /// As Term::evaluate().
  using Evaluate = std::function<bool(const VectorView& x, Eigen::Ref<Eigen::VectorXd> value,
                                      Eigen::MatrixXd* J)>;
  /// As Term::add_hessian().
  using AddHessian =
      std::function<void(const VectorView& x, const VectorView& weights, Eigen::MatrixXd& H)>;

  /// variables: 0 for any number. Without a Hessian, central differences of the Jacobian: 2 n more
  /// evaluations. Throws InvalidArgument: a size below 1, no function.
  FunctionTerm(std::string name, int size, int variables, Evaluate evaluate,
               AddHessian hessian = nullptr);

  std::string name() const override { return name_; }
  int size() const override { return size_; }
  int variables() const override { return variables_; }
  bool evaluate(const VectorView& x, Eigen::Ref<Eigen::VectorXd> value,
                Eigen::MatrixXd* J) const override;
  void add_hessian(const VectorView& x, const VectorView& weights,
                   Eigen::MatrixXd& H) const override;

 private:
  std::string name_;
  int size_;
  int variables_;
  Evaluate evaluate_;
  AddHessian hessian_;
};

/// The symmetric part of d(J^T weights)/dx by central differences of a term's Jacobian; one-sided
/// where the term does not exist on the other side. False: it exists on neither.
bool hessian_by_differences(const Term& term, const VectorView& x, const VectorView& weights,
                            Eigen::MatrixXd& H);

}  // namespace thing_kin
