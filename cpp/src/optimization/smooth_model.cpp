#include "smooth_model.hpp"

#include <algorithm>
#include <cmath>

namespace thing_kin {

using Eigen::Index;
using Eigen::VectorXd;

SmoothModel::SmoothModel(const ConvexModel& model)
    : model_(model),
      penalty_(VectorXd::Constant(model.rows(), model.penalty)),
      stiffness_(VectorXd::Ones(model.rows())),
      multipliers_(VectorXd::Zero(model.rows())),
      hessian_(model.hessian),
      center_(VectorXd::Zero(model.variables())) {}

void SmoothModel::set_proximity(double weight, const VectorXd& center) {
  hessian_ = model_.hessian;
  hessian_.diagonal().array() += weight;
  proximity_ = weight;
  center_ = center;
}

VectorXd SmoothModel::shifted(const VectorView& p) const {
  return model_.value + model_.jacobian * p + multipliers_.cwiseQuotient(stiffness_);
}

VectorXd SmoothModel::distance(const VectorView& p) const {
  const VectorXd w = shifted(p);
  return w - w.cwiseMax(model_.lower).cwiseMin(model_.upper);
}

VectorXd SmoothModel::pull(const VectorView& distance) const {
  return stiffness_.cwiseProduct(distance).cwiseMax(-penalty_).cwiseMin(penalty_);
}

double SmoothModel::value(const VectorView& p) const {
  const VectorXd d = distance(p);
  double sum = p.dot(model_.gradient + 0.5 * model_.hessian * p) +
               0.5 * proximity_ * (p - center_).squaredNorm();
  for (Index i = 0; i < d.size(); ++i) {
    const double edge = penalty_[i] / stiffness_[i];
    const double a = std::abs(d[i]);
    sum += a <= edge ? 0.5 * stiffness_[i] * a * a : penalty_[i] * (a - 0.5 * edge);
  }
  return sum;
}

VectorXd SmoothModel::gradient(const VectorView& p) const {
  return model_.gradient + model_.hessian * p + proximity_ * (p - center_) +
         model_.jacobian.transpose() * pull(distance(p));
}

// The slope along the line increases and is piecewise linear: regula falsi with bisection.
double SmoothModel::line_search(const VectorView& p, const VectorView& q) const {
  constexpr int kMost = 60;
  const VectorXd way = q - p;
  const auto slope = [&](double t) { return way.dot(gradient(p + t * way)); };
  double low = 0.0;
  double high = 1.0;
  double at_low = slope(low);
  double at_high = slope(high);
  if (at_high <= 0.0) {
    return 1.0;
  }
  if (at_low >= 0.0) {
    return 0.0;
  }
  for (int i = 0; i < kMost && high - low > 1e-14 * high; ++i) {
    const double secant = low + (high - low) * at_low / (at_low - at_high);
    const double t = i % 3 == 2 ? 0.5 * (low + high) : secant;
    const double at = slope(t);
    if (at == 0.0) {
      return t;
    }
    (at < 0.0 ? low : high) = t;
    (at < 0.0 ? at_low : at_high) = at;
  }
  return at_low < 0.0 && low > 0.0 ? low : high;
}

}  // namespace thing_kin
