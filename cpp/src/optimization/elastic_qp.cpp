#include "thing_kin/optimization/elastic_qp.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

namespace thing_kin {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxIterations = 80;
constexpr int kMostIdle = 8;
constexpr double kAccuracy = 1e-18;
constexpr double kOfSlope = 1e-4;      // so that its rounding does not hide the complementarity's
constexpr double kToBoundary = 0.995;  // of the way to the boundary

// Each side of each constraint that is finite: G p <= b + t, t >= 0 at the price mu.
struct Sides {
  MatrixXd G;
  VectorXd b;
  std::vector<Index> row;
  std::vector<double> sign;
};

Sides sides_of(const ConvexModel& model) {
  Sides sides;
  for (Index i = 0; i < model.rows(); ++i) {
    for (const double sign : {1.0, -1.0}) {
      if (std::isfinite(sign > 0.0 ? model.upper[i] : model.lower[i])) {
        sides.row.push_back(i);
        sides.sign.push_back(sign);
      }
    }
  }
  const auto count = static_cast<Index>(sides.row.size());
  sides.G.resize(count, model.variables());
  sides.b.resize(count);
  for (Index k = 0; k < count; ++k) {
    const auto j = static_cast<std::size_t>(k);
    const Index i = sides.row[j];
    sides.G.row(k) = sides.sign[j] * model.jacobian.row(i);
    sides.b[k] =
        sides.sign[j] > 0.0 ? model.upper[i] - model.value[i] : model.value[i] - model.lower[i];
  }
  return sides;
}

// All that is nonnegative, with what it is complementary to: s to y, t to v = mu - y, the ways to
// the box to their multipliers.
struct Iterate {
  VectorXd p;
  ArrayXd s, y, t, v;
  ArrayXd below, zb, above, za;
};

struct Targets {
  ArrayXd s, t, below, above;  // of the products
};

class InteriorPoint {
 public:
  explicit InteriorPoint(const ConvexModel& model) : model_(model), sides_(sides_of(model)) {
    // A variable without room stays where it is.
    fixed_ = (model.box_upper - model.box_lower).array() <= 0.0;
    start();
  }

  ConvexStep solve() {
    ConvexStep step;
    Iterate best = at_;
    double least = error();
    for (int idle = 0; step.iterations < kMaxIterations && idle < kMostIdle && least > kAccuracy;
         ++step.iterations) {
      factorize();
      const double mean = gap();
      const Iterate affine = direction(targets(0.0, nullptr));
      const double left = gap_after(affine, length(affine)) / mean;
      const Iterate d = direction(targets(mean * left * left * left, &affine));
      if (!d.p.allFinite() || !d.y.allFinite()) {
        break;
      }
      advance(d, std::min(1.0, kToBoundary * length(d)));
      // At the end of what doubles can do, iterations may lead away again.
      const double now = error();
      idle = now < least ? 0 : idle + 1;
      if (now < least) {
        least = now;
        best = at_;
      }
    }
    step.p = best.p.cwiseMax(model_.box_lower).cwiseMin(model_.box_upper);
    step.multipliers = VectorXd::Zero(model_.rows());
    for (std::size_t k = 0; k < sides_.row.size(); ++k) {
      step.multipliers[sides_.row[k]] += sides_.sign[k] * best.y[static_cast<Index>(k)];
    }
    return step;
  }

 private:
  void start() {
    const ArrayXd width = (model_.box_upper - model_.box_lower).array();
    const ArrayXd margin = 0.1 * width.min(1.0);
    at_.p = ArrayXd::Zero(width.size())
                .max(model_.box_lower.array() + margin)
                .min(model_.box_upper.array() - margin)
                .matrix();
    at_.p = fixed_.select(0.0, at_.p);
    at_.below = fixed_.select(1.0, at_.p.array() - model_.box_lower.array());
    at_.above = fixed_.select(1.0, model_.box_upper.array() - at_.p.array());
    const ArrayXd outside = (sides_.G * at_.p - sides_.b).array();
    at_.t = outside.max(0.0) + 1.0;
    at_.s = at_.t - outside;
    at_.y = ArrayXd::Constant(outside.size(), 0.5 * model_.penalty);
    at_.v = at_.y;
    const double slope = std::max(1e-3, model_.gradient.cwiseAbs().maxCoeff());
    at_.zb = slope / at_.below.max(1.0);
    at_.za = slope / at_.above.max(1.0);
  }

  double gap() const {
    const double products = (at_.s * at_.y).sum() + (at_.t * at_.v).sum() +
                            room((at_.below * at_.zb).eval()) + room((at_.above * at_.za).eval());
    return products / count();
  }

  double gap_after(const Iterate& d, double a) const {
    const double products = ((at_.s + a * d.s) * (at_.y + a * d.y)).sum() +
                            ((at_.t + a * d.t) * (at_.v + a * d.v)).sum() +
                            room(((at_.below + a * d.below) * (at_.zb + a * d.zb)).eval()) +
                            room(((at_.above + a * d.above) * (at_.za + a * d.za)).eval());
    return std::max(0.0, products / count());
  }

  double room(const ArrayXd& products) const { return fixed_.select(0.0, products).sum(); }

  double count() const {
    return static_cast<double>(std::max<Index>(1, 2 * at_.s.size() + 2 * fixed_.size()));
  }

  VectorXd slope() const {
    VectorXd g = model_.gradient + model_.hessian * at_.p;
    g += sides_.G.transpose() * at_.y.matrix() + (at_.za - at_.zb).matrix();
    return fixed_.select(0.0, g);
  }

  // Complementarity, relative to the gradient's size, and what is left of the gradient, relative to
  // the largest number in it.
  double error() const {
    const double scale = std::max(1e-12, model_.gradient.cwiseAbs().maxCoeff());
    const double pulls =
        sides_.G.size() == 0 ? 0.0 : model_.penalty * sides_.G.cwiseAbs().maxCoeff();
    return std::max(gap() / std::max(1.0, scale),
                    kOfSlope * slope().cwiseAbs().maxCoeff() / std::max(scale, pulls));
  }

  void factorize() {
    weight_ = 1.0 / (at_.t / at_.v + at_.s / at_.y);
    MatrixXd K = model_.hessian;
    K += sides_.G.transpose() * weight_.matrix().asDiagonal() * sides_.G;
    K.diagonal().array() += at_.zb / at_.below + at_.za / at_.above;
    for (Index i = 0; i < fixed_.size(); ++i) {
      if (fixed_[i]) {
        K.row(i).setZero();
        K.col(i).setZero();
        K(i, i) = 1.0;
      }
    }
    // Rounding must not make it indefinite.
    K.diagonal() *= 1.0 + 1e-15;
    cholesky_.compute(K);
  }

  Targets targets(double mean, const Iterate* affine) const {
    Targets to{ArrayXd::Constant(at_.s.size(), mean), ArrayXd::Constant(at_.t.size(), mean),
               ArrayXd::Constant(at_.p.size(), mean), ArrayXd::Constant(at_.p.size(), mean)};
    if (affine != nullptr) {
      to.s -= affine->s * affine->y;
      to.t -= affine->t * affine->v;
      to.below -= affine->below * affine->zb;
      to.above -= affine->above * affine->za;
    }
    return to;
  }

  Iterate direction(const Targets& to) const {
    const ArrayXd residual =
        (sides_.b - sides_.G * at_.p).array() + at_.t - at_.s;  // rounding, else 0
    const ArrayXd r = (to.t / at_.v - at_.t) - (to.s / at_.y - at_.s) + residual;
    VectorXd rhs = -slope() + sides_.G.transpose() * (weight_ * r).matrix();
    rhs.array() += (to.below / at_.below - at_.zb) - (to.above / at_.above - at_.za);
    rhs = fixed_.select(0.0, rhs);
    Iterate d;
    d.p = cholesky_.solve(rhs);
    d.y = weight_ * ((sides_.G * d.p).array() - r);
    d.v = -d.y;
    d.t = (to.t - at_.v * at_.t + at_.t * d.y) / at_.v;
    d.s = (to.s - at_.y * at_.s - at_.s * d.y) / at_.y;
    d.below = fixed_.select(0.0, d.p.array());
    d.above = -d.below;
    d.zb = fixed_.select(0.0, (to.below - at_.zb * d.below) / at_.below - at_.zb);
    d.za = fixed_.select(0.0, (to.above - at_.za * d.above) / at_.above - at_.za);
    return d;
  }

  // As far as everything stays nonnegative, at most 1 / kToBoundary.
  double length(const Iterate& d) const {
    double a = 1.0 / kToBoundary;
    const auto keep = [&](const ArrayXd& at, const ArrayXd& by) {
      for (Index i = 0; i < at.size(); ++i) {
        a = by[i] < 0.0 ? std::min(a, -at[i] / by[i]) : a;
      }
    };
    keep(at_.s, d.s);
    keep(at_.y, d.y);
    keep(at_.t, d.t);
    keep(at_.v, d.v);
    keep(at_.below, d.below);
    keep(at_.zb, d.zb);
    keep(at_.above, d.above);
    keep(at_.za, d.za);
    return a;
  }

  void advance(const Iterate& d, double a) {
    constexpr double kLeast = 1e-300;
    at_.p += a * d.p;
    const auto move = [&](ArrayXd& at, const ArrayXd& by) { at = (at + a * by).max(kLeast); };
    move(at_.s, d.s);
    move(at_.y, d.y);
    move(at_.t, d.t);
    move(at_.v, d.v);
    move(at_.below, d.below);
    move(at_.zb, d.zb);
    move(at_.above, d.above);
    move(at_.za, d.za);
  }

  const ConvexModel& model_;
  Sides sides_;
  Eigen::Array<bool, Eigen::Dynamic, 1> fixed_;
  Iterate at_;
  ArrayXd weight_;
  Eigen::LDLT<MatrixXd> cholesky_;
};

}  // namespace

ConvexStep ElasticQp::minimize(const ConvexModel& model) const {
  return InteriorPoint(model).solve();
}

}  // namespace thing_kin
