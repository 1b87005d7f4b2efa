#pragma once

#include <memory>
#include <string>
#include <vector>

#include "thing_kin/model/chain.hpp"
#include "thing_kin/optimization/term.hpp"

namespace thing_kin {

/// weight times the sum of a term's entries, or of their squares.
struct Objective {
  std::shared_ptr<const Term> term;
  double weight = 1.0;
  bool squares = false;
};

/// lower <= term <= upper, entry by entry.
struct Constraint {
  std::shared_ptr<const Term> term;
  Eigen::VectorXd lower, upper;
  std::string name;  ///< no other constraint has it
  int row = 0;       ///< its first among all constraints' entries
};

/// A constraint or bound that does not hold, and by how much.
struct Violation {
  std::string name;
  double amount = 0.0;
};

/// Objective and constraints at one x. Undefined numbers where a term does not exist there.
struct Linearization {
  double objective = 0.0;
  Eigen::VectorXd gradient;  ///< (n)
  Eigen::VectorXd value;     ///< (m), of the constraints
  Eigen::MatrixXd jacobian;  ///< (m, n)
};

/// [M17] (4.19): minimize f(x) subject to lower <= x <= upper and bounds on vector functions of x.
/// Crossed bounds are kept: a solver reports them as infeasible.
class Problem {
 public:
  /// Variables named x[0], x[1]... Throws InvalidArgument: no variable, sizes that differ, NaN.
  Problem(Eigen::VectorXd lower, Eigen::VectorXd upper);

  /// The joints of a robot, by name, within its limits.
  explicit Problem(std::shared_ptr<const Chain> robot);

  int variables() const { return static_cast<int>(lower_.size()); }
  const std::shared_ptr<const Chain>& robot() const { return robot_; }
  const std::vector<std::string>& names() const { return names_; }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }

  const std::vector<Objective>& objectives() const { return objectives_; }
  const std::vector<Constraint>& constraints() const { return constraints_; }

  /// Entries of all constraints together.
  int rows() const { return static_cast<int>(row_lower_.size()); }
  const Eigen::VectorXd& row_lower() const { return row_lower_; }
  const Eigen::VectorXd& row_upper() const { return row_upper_; }

  /// "pose[2]", "clearance[11] (sphere 2 (forearm) and obstacle 0)".
  std::string row_name(Eigen::Index row) const;

  /// Throws InvalidArgument: a term of another number of variables, a weight that is not finite.
  void minimize(std::shared_ptr<const Term> term, double weight = 1.0);
  void minimize_squares(std::shared_ptr<const Term> term, double weight = 1.0);

  /// One bound for all entries, or one each; -inf and inf: none. `name`: default the term's. Throws
  /// InvalidArgument for NaN and wrong sizes.
  void constrain(const std::shared_ptr<const Term>& term, const VectorView& lower,
                 const VectorView& upper, const std::string& name = "");

  /// Throws InvalidArgument: no such variable, NaN.
  void bound(int variable, double lower, double upper);
  int variable(const std::string& name) const;

  /// f and the constraints' values; false where one of them does not exist.
  bool evaluate(const VectorView& x, double& objective, Eigen::VectorXd& value) const;

  /// The same with first derivatives.
  bool linearize(const VectorView& x, Linearization& at) const;

  /// H += scale d^2f/dx^2 + sum_i multipliers_i d^2 value_i/dx^2.
  void add_hessian(const VectorView& x, double scale, const VectorView& multipliers,
                   Eigen::MatrixXd& H) const;

  /// How far each constraint's value is outside: (m), >= 0.
  Eigen::VectorXd row_violations(const VectorView& value) const;

  /// Constraints and bounds that x violates by more than `tolerance`, the worst first.
  std::vector<Violation> violations(const VectorView& x, const VectorView& value,
                                    double tolerance) const;

  /// The first term that does not exist at x; empty: all do.
  std::string undefined_at(const VectorView& x) const;

 private:
  void check(const Term& term) const;
  std::string unused(const std::string& name) const;

  std::shared_ptr<const Chain> robot_;
  std::vector<std::string> names_;
  Eigen::VectorXd lower_, upper_, row_lower_, row_upper_;
  std::vector<Objective> objectives_;
  std::vector<Constraint> constraints_;
};

}  // namespace thing_kin
