#include "thing_kin/optimization/optimality.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "thing_kin/linalg/signed_least_squares.hpp"

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

// A side of a constraint or of a variable's bounds that may push.
struct Side {
  Index index;  // row, or m + variable
  double sign;  // 1: the upper one
  bool both;    // an equality
  double slack;
};

void collect(const VectorView& value, const VectorView& lower, const VectorView& upper,
             double activity, Index first, std::vector<Side>& sides) {
  const auto near = [&](double slack, double bound) {
    return std::isfinite(bound) && slack <= activity * std::max(1.0, std::abs(bound));
  };
  for (Index i = 0; i < value.size(); ++i) {
    if (lower[i] == upper[i]) {
      sides.push_back({first + i, 1.0, true, 0.0});
      continue;
    }
    if (near(upper[i] - value[i], upper[i])) {
      sides.push_back({first + i, 1.0, false, std::abs(upper[i] - value[i])});
    }
    if (near(value[i] - lower[i], lower[i])) {
      sides.push_back({first + i, -1.0, false, std::abs(value[i] - lower[i])});
    }
  }
}

double largest(const VectorXd& v) { return v.size() == 0 ? 0.0 : v.cwiseAbs().maxCoeff(); }

}  // namespace

Optimality optimality(const Problem& problem, const VectorView& x, const Linearization& at,
                      double activity) {
  const Index n = x.size();
  const Index m = problem.rows();
  std::vector<Side> sides;
  collect(at.value, problem.row_lower(), problem.row_upper(), activity, 0, sides);
  collect(x, problem.lower(), problem.upper(), activity, m, sides);
  const auto count = static_cast<Index>(sides.size());
  Eigen::MatrixXd pull(n, count);
  VectorXd norms(count);
  std::vector<bool> free;
  for (Index k = 0; k < count; ++k) {
    const Side& side = sides[static_cast<std::size_t>(k)];
    pull.col(k) = side.sign * (side.index < m ? VectorXd(at.jacobian.row(side.index).transpose())
                                              : VectorXd::Unit(n, side.index - m));
    // Of one length each, so that what is near rank loss is so for its direction.
    norms[k] = pull.col(k).norm() > 0.0 ? pull.col(k).norm() : 1.0;
    pull.col(k) /= norms[k];
    free.push_back(side.both);
  }
  const VectorXd force = signed_least_squares(pull, -at.gradient, free);

  Optimality result;
  VectorXd multipliers = VectorXd::Zero(m + n);
  double complementarity = 0.0;
  for (Index k = 0; k < count; ++k) {
    const Side& side = sides[static_cast<std::size_t>(k)];
    multipliers[side.index] += side.sign * force[k] / norms[k];
    complementarity = std::max(complementarity, std::abs(force[k] / norms[k]) * side.slack);
  }
  result.multipliers = multipliers.head(m);
  result.bound_multipliers = multipliers.tail(n);
  const double scale = std::max(1.0, largest(at.gradient));
  result.residual = std::max(largest(at.gradient + pull * force) / std::max(scale, largest(force)),
                             complementarity / scale);
  result.violation = largest(problem.row_violations(at.value));
  result.violation =
      std::max(result.violation,
               (problem.lower() - x).cwiseMax(x - problem.upper()).cwiseMax(0.0).maxCoeff());
  return result;
}

}  // namespace thing_kin
