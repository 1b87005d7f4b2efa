#include <algorithm>
#include <vector>

#include "sqp_search.hpp"
#include "thing_kin/optimization/convexify.hpp"

// The convexify step of Algorithm 2: the convex model about x.

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A violation has no curvature of its own: this makes restoring steps short.
constexpr double kRestoringCurvature = 1e-2;

}  // namespace

SqpSearch::Model SqpSearch::convexify(Convexity convexity) const {
  const VectorXd pull = merit_.squares * signed_violation();
  Model model;
  model.gradient = merit_.scale * at_.gradient + at_.jacobian.transpose() * pull;
  model.hessian = MatrixXd::Zero(x_.size(), x_.size());
  problem_.add_hessian(x_, merit_.scale, multipliers_ + pull, model.hessian);
  const MatrixXd violated =
      (pull.array() != 0.0).cast<double>().matrix().asDiagonal() * at_.jacobian;
  model.hessian += merit_.squares * violated.transpose() * violated;
  if (merit_.scale == 0.0) {
    model.hessian.diagonal().array() += kRestoringCurvature * merit_.penalty;
  }
  const Index rows = merit_.penalty > 0.0 ? at_.value.size() : 0;
  model.convex = {model.gradient,
                  {},
                  merit_.penalty,
                  at_.value.head(rows),
                  at_.jacobian.topRows(rows),
                  problem_.row_lower().head(rows),
                  problem_.row_upper().head(rows),
                  (problem_.lower() - x_).cwiseMax(-delta_).cwiseMin(0.0),
                  (problem_.upper() - x_).cwiseMin(delta_).cwiseMax(0.0)};
  add_curvature(convexity, model);
  return model;
}

void SqpSearch::add_curvature(Convexity convexity, Model& model) const {
  if (!model.hessian.allFinite()) {
    model.hessian.setZero();
  }
  ConvexQuadratic convex = without_negative_curvature(model.hessian);
  const double change = (convex.hessian - model.hessian).cwiseAbs().maxCoeff();
  const bool is_convex = change <= 1e-12 * model.hessian.cwiseAbs().maxCoeff();
  if (convexity == Convexity::kAcross && !is_convex && merit_.squares == 0.0) {
    VectorXd value;
    const MatrixXd C = held(value);
    if (C.rows() > 0) {
      if (std::optional<ConvexQuadratic> across = convex_across(model.hessian, C, value)) {
        convex = std::move(*across);
        model.is_clipped = false;
      }
    }
  }
  model.convex.hessian = convex.hessian;
  model.convex.gradient += convex.slope;
}

// What the next step is expected to meet exactly: equalities, constraints that pushed in the last
// one, bounds that are pushed against.
MatrixXd SqpSearch::held(VectorXd& value) const {
  std::vector<Index> rows;
  std::vector<Index> variables;
  const VectorXd slope = merit_.scale * at_.gradient + at_.jacobian.transpose() * multipliers_;
  for (Index i = 0; i < at_.value.size(); ++i) {
    const double push = std::abs(multipliers_[i]);
    if (problem_.row_lower()[i] == problem_.row_upper()[i] ||
        (push > 1e-8 * merit_.penalty && push < (1.0 - 1e-8) * merit_.penalty)) {
      rows.push_back(i);
    }
  }
  for (Index j = 0; j < x_.size(); ++j) {
    if ((x_[j] <= problem_.lower()[j] && slope[j] > 0.0) ||
        (x_[j] >= problem_.upper()[j] && slope[j] < 0.0)) {
      variables.push_back(j);
    }
  }
  const auto m = static_cast<Index>(rows.size());
  const auto b = static_cast<Index>(variables.size());
  MatrixXd C = MatrixXd::Zero(m + b, x_.size());
  value = VectorXd::Zero(m + b);
  for (Index k = 0; k < m; ++k) {
    const Index i = rows[static_cast<std::size_t>(k)];
    const double bound = multipliers_[i] < 0.0 ? problem_.row_lower()[i] : problem_.row_upper()[i];
    C.row(k) = at_.jacobian.row(i);
    value[k] = at_.value[i] - bound;
  }
  for (Index k = 0; k < b; ++k) {
    C(m + k, variables[static_cast<std::size_t>(k)]) = 1.0;
  }
  return C;
}

}  // namespace thing_kin
