#include "thing_kin/optimization/derivative_check.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "thing_kin/core/error.hpp"
#include "thing_kin/core/tolerance.hpp"
#include "thing_kin/optimization/function_term.hpp"

namespace thing_kin {

namespace {

[[noreturn]] void throw_undefined(const Term& term) {
  throw InvalidArgument("x", quoted(term.name()).append(" that does not exist at x or next to it"),
                        "an x where it and its derivative do");
}

Eigen::VectorXd value_at(const Term& term, const Eigen::VectorXd& x) {
  Eigen::VectorXd value(term.size());
  if (!term.evaluate(x, value, nullptr) || !value.allFinite()) {
    throw_undefined(term);
  }
  return value;
}

Eigen::VectorXd difference(const Term& term, const VectorView& x, Eigen::Index i, double h) {
  Eigen::VectorXd ahead = x;
  Eigen::VectorXd behind = x;
  ahead[i] += h;
  behind[i] -= h;
  return (value_at(term, ahead) - value_at(term, behind)) / (ahead[i] - behind[i]);
}

void note(const Eigen::MatrixXd& given, const Eigen::MatrixXd& expected, int entry,
          DerivativeDifference& worst) {
  const double scale = std::max({1.0, given.cwiseAbs().maxCoeff(), expected.cwiseAbs().maxCoeff()});
  Eigen::Index row = 0;
  Eigen::Index col = 0;
  const double largest = (given - expected).cwiseAbs().maxCoeff(&row, &col) / scale;
  if (largest >= worst.largest) {
    worst = {
        largest,           entry, static_cast<int>(row), static_cast<int>(col), given(row, col),
        expected(row, col)};
  }
}

DerivativeDifference check_jacobian(const Term& term, const VectorView& x) {
  Eigen::VectorXd value(term.size());
  Eigen::MatrixXd J(term.size(), x.size());
  if (!term.evaluate(x, value, &J) || !J.allFinite()) {
    throw_undefined(term);
  }
  Eigen::MatrixXd D(J.rows(), J.cols());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    // With an error of h^4, the balance with rounding eps/h is at the fifth root.
    const double h = std::pow(kEpsilon, 0.2) * std::max(1.0, std::abs(x[i]));
    D.col(i) = (4.0 * difference(term, x, i, 0.5 * h) - difference(term, x, i, h)) / 3.0;
  }
  DerivativeDifference worst;
  note(J.transpose(), D.transpose(), 0, worst);
  worst.entry = worst.col;
  worst.col = 0;
  return worst;
}

}  // namespace

DerivativeCheck check_derivatives(const Term& term, const VectorView& x) {
  DerivativeCheck check{check_jacobian(term, x), {}};
  for (int entry = 0; entry < term.size(); ++entry) {
    const Eigen::VectorXd weights = Eigen::VectorXd::Unit(term.size(), entry);
    Eigen::MatrixXd given = Eigen::MatrixXd::Zero(x.size(), x.size());
    Eigen::MatrixXd expected;
    term.add_hessian(x, weights, given);
    if (!hessian_by_differences(term, x, weights, expected)) {
      throw_undefined(term);
    }
    note(given, expected, entry, check.hessian);
  }
  return check;
}

}  // namespace thing_kin
