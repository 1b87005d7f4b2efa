#include "thing_kin/optimization/problem.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

void check_bounds(const VectorView& bounds, Eigen::Index size, const char* argument) {
  if (bounds.size() != size) {
    throw InvalidArgument(argument, std::to_string(bounds.size()).append(" numbers"),
                          std::to_string(size));
  }
  if (bounds.array().isNaN().any()) {
    throw InvalidArgument(argument, "nan", "numbers, or -inf and inf for no bound");
  }
}

Eigen::VectorXd spread(const VectorView& bounds, Eigen::Index size, const char* argument) {
  Eigen::VectorXd all = bounds;
  if (bounds.size() == 1) {
    all = Eigen::VectorXd::Constant(size, bounds[0]);
  }
  check_bounds(all, size, argument);
  return all;
}

void append(Eigen::VectorXd& to, const Eigen::VectorXd& more) {
  const Eigen::Index size = to.size();
  to.conservativeResize(size + more.size());
  to.tail(more.size()) = more;
}

void check_weight(double weight, double least) {
  if (!(weight >= least) || !std::isfinite(weight)) {
    throw InvalidArgument("weight", text(weight),
                          least < 0.0 ? "a finite number" : "a finite number >= 0");
  }
}

}  // namespace

Problem::Problem(Eigen::VectorXd lower, Eigen::VectorXd upper)
    : lower_(std::move(lower)), upper_(std::move(upper)) {
  if (lower_.size() == 0) {
    throw InvalidArgument("n", "0", "at least one variable");
  }
  check_bounds(lower_, lower_.size(), "lower");
  check_bounds(upper_, lower_.size(), "upper");
  for (Eigen::Index i = 0; i < lower_.size(); ++i) {
    names_.push_back(std::string("x[").append(std::to_string(i)).append("]"));
  }
}

Problem::Problem(std::shared_ptr<const Chain> robot)
    : robot_(std::move(robot)),
      names_(robot_->joint_names()),
      lower_(robot_->lower()),
      upper_(robot_->upper()) {}

std::string Problem::row_name(Eigen::Index row) const {
  const auto above = [&](const Constraint& constraint) { return constraint.row > row; };
  const Constraint& constraint = *std::prev(std::ranges::find_if(constraints_, above));
  const Eigen::Index entry = row - constraint.row;
  std::string name = constraint.name;
  if (constraint.lower.size() > 1) {
    name.append("[").append(std::to_string(entry)).append("]");
  }
  const std::string about = constraint.term->describe(static_cast<int>(entry));
  return about.empty() ? name : name.append(" (").append(about).append(")");
}

void Problem::minimize(std::shared_ptr<const Term> term, double weight) {
  check(*term);
  check_weight(weight, -std::numeric_limits<double>::infinity());
  objectives_.push_back({std::move(term), weight, false});
}

void Problem::minimize_squares(std::shared_ptr<const Term> term, double weight) {
  check(*term);
  check_weight(weight, 0.0);
  objectives_.push_back({std::move(term), weight, true});
}

void Problem::constrain(const std::shared_ptr<const Term>& term, const VectorView& lower,
                        const VectorView& upper, const std::string& name) {
  check(*term);
  Constraint constraint{term, spread(lower, term->size(), "lower"),
                        spread(upper, term->size(), "upper"),
                        unused(name.empty() ? term->name() : name), rows()};
  append(row_lower_, constraint.lower);
  append(row_upper_, constraint.upper);
  constraints_.push_back(std::move(constraint));
}

void Problem::bound(int variable, double lower, double upper) {
  if (variable < 0 || variable >= variables()) {
    throw InvalidArgument("variable", std::to_string(variable),
                          std::string("0 to ").append(std::to_string(variables() - 1)));
  }
  if (std::isnan(lower) || std::isnan(upper)) {
    throw InvalidArgument(std::isnan(lower) ? "lower" : "upper", "nan",
                          "a number, or -inf and inf for no bound");
  }
  lower_[variable] = lower;
  upper_[variable] = upper;
}

int Problem::variable(const std::string& name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) {
    std::string known;
    for (const std::string& one : names_) {
      known.append(known.empty() ? "one of " : ", ").append(quoted(one));
    }
    throw InvalidArgument("variable", quoted(name), known);
  }
  return static_cast<int>(found - names_.begin());
}

void Problem::check(const Term& term) const {
  if (term.variables() != 0 && term.variables() != variables()) {
    throw InvalidArgument("term",
                          quoted(term.name())
                              .append(" of ")
                              .append(std::to_string(term.variables()))
                              .append(" variables"),
                          std::string("one of ").append(std::to_string(variables())));
  }
}

// "base_distance", then "base_distance (2)".
std::string Problem::unused(const std::string& name) const {
  std::string free = name;
  const auto taken = [&](const Constraint& constraint) { return constraint.name == free; };
  for (int i = 2; std::ranges::any_of(constraints_, taken); ++i) {
    free = std::string(name).append(" (").append(std::to_string(i)).append(")");
  }
  return free;
}

}  // namespace thing_kin
