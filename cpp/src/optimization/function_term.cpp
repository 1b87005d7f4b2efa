#include "thing_kin/optimization/function_term.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "thing_kin/core/error.hpp"
#include "thing_kin/core/tolerance.hpp"

namespace thing_kin {

namespace {

// J^T weights at x.
bool slope(const Term& term, const VectorView& x, const VectorView& weights, Eigen::VectorXd& g) {
  Eigen::VectorXd value(term.size());
  Eigen::MatrixXd J(term.size(), x.size());
  if (!term.evaluate(x, value, &J) || !J.allFinite()) {
    return false;
  }
  g = J.transpose() * weights;
  return true;
}

}  // namespace

FunctionTerm::FunctionTerm(std::string name, int size, int variables, Evaluate evaluate,
                           AddHessian hessian)
    : name_(std::move(name)),
      size_(size),
      variables_(variables),
      evaluate_(std::move(evaluate)),
      hessian_(std::move(hessian)) {
  if (size < 1) {
    throw InvalidArgument("size", std::to_string(size), "at least 1");
  }
  if (variables < 0) {
    throw InvalidArgument("n", std::to_string(variables), "at least 1, or 0 for any number");
  }
  if (!evaluate_) {
    throw InvalidArgument("evaluate", "none", "a function");
  }
}

bool FunctionTerm::evaluate(const VectorView& x, Eigen::Ref<Eigen::VectorXd> value,
                            Eigen::MatrixXd* J) const {
  return evaluate_(x, value, J);
}

void FunctionTerm::add_hessian(const VectorView& x, const VectorView& weights,
                               Eigen::MatrixXd& H) const {
  if (hessian_) {
    hessian_(x, weights, H);
    return;
  }
  Eigen::MatrixXd differences;
  if (hessian_by_differences(*this, x, weights, differences)) {
    H += differences;
  }
}

bool hessian_by_differences(const Term& term, const VectorView& x, const VectorView& weights,
                            Eigen::MatrixXd& H) {
  Eigen::VectorXd here;
  if (!slope(term, x, weights, here)) {
    return false;
  }
  Eigen::MatrixXd D(x.size(), x.size());
  Eigen::VectorXd at = x;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    // Truncation h^2 and rounding eps/h are in balance.
    const double h = std::cbrt(kEpsilon) * std::max(1.0, std::abs(x[i]));
    Eigen::VectorXd ahead = here;
    Eigen::VectorXd behind = here;
    at[i] = x[i] + h;
    const double above = slope(term, at, weights, ahead) ? at[i] : x[i];
    at[i] = x[i] - h;
    const double below = slope(term, at, weights, behind) ? at[i] : x[i];
    at[i] = x[i];
    if (above == below) {
      return false;
    }
    D.col(i) = (ahead - behind) / (above - below);
  }
  H = 0.5 * (D + D.transpose());
  return true;
}

}  // namespace thing_kin
