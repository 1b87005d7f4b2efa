#include <algorithm>
#include <cmath>
#include <functional>

#include "thing_kin/optimization/problem.hpp"

// What a Problem is at one x.

namespace thing_kin {

namespace {

// A term that says it exists and is not finite does not.
bool value_of(const Term& term, const VectorView& x, Eigen::VectorXd& value, Eigen::MatrixXd* J) {
  value.resize(term.size());
  if (J != nullptr) {
    J->resize(term.size(), x.size());
  }
  return term.evaluate(x, value, J) && value.allFinite() && (J == nullptr || J->allFinite());
}

double objective_of(const Objective& objective, const Eigen::VectorXd& value) {
  return objective.weight * (objective.squares ? value.squaredNorm() : value.sum());
}

// d objective / d value.
Eigen::VectorXd slope_of(const Objective& objective, const Eigen::VectorXd& value) {
  return objective.squares ? Eigen::VectorXd(2.0 * objective.weight * value)
                           : Eigen::VectorXd::Constant(value.size(), objective.weight);
}

void add_bound_violations(const Problem& problem, const VectorView& x, double tolerance,
                          std::vector<Violation>& all) {
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double lower = problem.lower()[i];
    const double upper = problem.upper()[i];
    const double amount = std::max({lower - x[i], x[i] - upper, lower - upper});
    if (amount > tolerance) {
      const std::string& name = problem.names()[static_cast<std::size_t>(i)];
      all.push_back(
          {std::string(lower > upper ? "crossed bounds of " : "bound of ").append(name), amount});
    }
  }
}

}  // namespace

bool Problem::evaluate(const VectorView& x, double& objective, Eigen::VectorXd& value) const {
  Eigen::VectorXd entries;
  objective = 0.0;
  value.resize(rows());
  for (const Objective& one : objectives_) {
    if (!value_of(*one.term, x, entries, nullptr)) {
      return false;
    }
    objective += objective_of(one, entries);
  }
  for (const Constraint& constraint : constraints_) {
    if (!value_of(*constraint.term, x, entries, nullptr)) {
      return false;
    }
    value.segment(constraint.row, entries.size()) = entries;
  }
  return std::isfinite(objective);
}

bool Problem::linearize(const VectorView& x, Linearization& at) const {
  Eigen::VectorXd entries;
  Eigen::MatrixXd J;
  at.objective = 0.0;
  at.gradient = Eigen::VectorXd::Zero(variables());
  at.value.resize(rows());
  at.jacobian.resize(rows(), variables());
  for (const Objective& one : objectives_) {
    if (!value_of(*one.term, x, entries, &J)) {
      return false;
    }
    at.objective += objective_of(one, entries);
    at.gradient += J.transpose() * slope_of(one, entries);
  }
  for (const Constraint& constraint : constraints_) {
    if (!value_of(*constraint.term, x, entries, &J)) {
      return false;
    }
    at.value.segment(constraint.row, entries.size()) = entries;
    at.jacobian.middleRows(constraint.row, entries.size()) = J;
  }
  return std::isfinite(at.objective) && at.gradient.allFinite();
}

void Problem::add_hessian(const VectorView& x, double scale, const VectorView& multipliers,
                          Eigen::MatrixXd& H) const {
  Eigen::VectorXd entries;
  Eigen::MatrixXd J;
  for (const Objective& one : objectives_) {
    if (scale == 0.0 || !value_of(*one.term, x, entries, one.squares ? &J : nullptr)) {
      continue;
    }
    if (one.squares) {
      H += 2.0 * scale * one.weight * J.transpose() * J;
    }
    one.term->add_hessian(x, scale * slope_of(one, entries), H);
  }
  for (const Constraint& constraint : constraints_) {
    const auto weights = multipliers.segment(constraint.row, constraint.lower.size());
    if ((weights.array() != 0.0).any()) {
      constraint.term->add_hessian(x, weights, H);
    }
  }
}

Eigen::VectorXd Problem::row_violations(const VectorView& value) const {
  return (row_lower_ - value).cwiseMax(value - row_upper_).cwiseMax(0.0);
}

std::vector<Violation> Problem::violations(const VectorView& x, const VectorView& value,
                                           double tolerance) const {
  std::vector<Violation> all;
  const Eigen::VectorXd amounts = row_violations(value);
  for (Eigen::Index row = 0; row < amounts.size(); ++row) {
    if (amounts[row] > tolerance) {
      all.push_back({row_name(row), amounts[row]});
    }
  }
  add_bound_violations(*this, x, tolerance, all);
  std::ranges::stable_sort(all, std::ranges::greater{}, &Violation::amount);
  return all;
}

std::string Problem::undefined_at(const VectorView& x) const {
  Eigen::VectorXd entries;
  Eigen::MatrixXd J;
  for (const Objective& one : objectives_) {
    if (!value_of(*one.term, x, entries, &J)) {
      return one.term->name();
    }
  }
  for (const Constraint& constraint : constraints_) {
    if (!value_of(*constraint.term, x, entries, &J)) {
      return constraint.name;
    }
  }
  return "";
}

}  // namespace thing_kin
