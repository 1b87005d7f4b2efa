#include "limited_problem.hpp"

#include <algorithm>
#include <utility>

#include "thing_kin/linalg/hierarchical_qp.hpp"
#include "thing_kin/linalg/small_product.hpp"

namespace thing_kin {

namespace {

// A value this near to its bound, relative to its row's length and the step's, is at it.
constexpr double kAtBound = 1e-11;

// -1 or 1 where a value is at its lower or upper bound or beyond.
std::int8_t side_of(double value, double lower, double upper, double rounding) {
  if (value >= upper - rounding) {
    return 1;
  }
  return value <= lower + rounding ? std::int8_t{-1} : std::int8_t{0};
}

bool within(const SmallVector& value, const SmallVector& lower, const SmallVector& upper) {
  return (value.array() >= lower.array()).all() && (value.array() <= upper.array()).all();
}

// The recursion of Siciliano & Slotine as if there were no limits.
void recursion(const LimitedProblem& problem, JointVector& dq) {
  const int n = problem.joints;
  dq.setZero(n);
  SmallMatrix Z;
  bool whole = true;  // Z = I
  RegularizedRows rows;
  SmallVector z;
  SmallMatrix V2;
  for (int i = 0; i < problem.count; ++i) {
    const LimitedProblem::Level& level = problem.levels[static_cast<std::size_t>(i)];
    if (level.interval || (!whole && Z.cols() == 0)) {
      continue;
    }
    const SmallMatrix& J = level.value.jacobian;
    SmallMatrix reduced;
    if (!whole) {
      multiply(J, Z, reduced);
    }
    rows.factor(whole ? J : reduced, J.norm(), problem.regularization);
    SmallVector rest = level.wanted;
    if (!whole) {
      accumulate(-1.0, J, dq, rest);
    }
    rows.solve(rest, z);
    if (whole) {
      dq = z;
    } else {
      accumulate(1.0, Z, z, dq);
    }
    if (i + 1 < problem.count || problem.wish != nullptr) {
      rows.null_space(V2);
      const SmallMatrix above = Z;
      whole ? static_cast<void>(Z = V2) : multiply(above, V2, Z);
    }
    whole = false;
  }
  if (problem.wish != nullptr) {
    const Eigen::Map<const Eigen::VectorXd> wish(problem.wish, n);
    if (whole) {
      dq = wish;
    } else {
      const SmallVector along = Z.transpose() * wish;
      dq.noalias() += Z * along;
    }
  }
}

// Whether a step keeps every limit and interval: then no other keeps more.
bool keeps_all(const LimitedProblem& problem, const JointVector& dq) {
  bool kept = within(dq, problem.box.lower, problem.box.upper);
  for (int i = 0; kept && i < problem.count; ++i) {
    const LimitedProblem::Level& level = problem.levels[static_cast<std::size_t>(i)];
    kept = !level.interval || within(level.value.jacobian * dq, level.lower, level.upper);
  }
  return kept && (problem.wheel_rows.rows() == 0 ||
                  within(problem.wheel_rows * dq, -problem.wheel_limit, problem.wheel_limit));
}

}  // namespace

StepStatus solve(const LimitedProblem& problem, JointVector& dq, int& iterations) noexcept {
  iterations = 0;
  recursion(problem, dq);
  if (keeps_all(problem, dq)) {
    return StepStatus::kOptimal;
  }
  if (!dq.allFinite()) {
    dq.setZero();
  }
  HierarchicalQp qp;
  qp.begin(problem.box.lower, problem.box.upper, dq);
  if (problem.wheel_rows.rows() > 0) {
    qp.keep(problem.wheel_rows, -problem.wheel_limit, problem.wheel_limit);
  }
  for (int i = 0; i < problem.count; ++i) {
    const LimitedProblem::Level& level = problem.levels[static_cast<std::size_t>(i)];
    if (level.interval) {
      qp.keep(level.value.jacobian, level.lower, level.upper);
    } else {
      qp.minimize(level.value.jacobian, level.wanted, problem.regularization);
    }
  }
  JointVector wish = JointVector::Zero(problem.joints);
  if (problem.wish != nullptr) {
    wish = Eigen::Map<const Eigen::VectorXd>(problem.wish, problem.joints);
  }
  qp.nearest_to(wish);
  qp.finish();
  dq = qp.x();
  iterations = qp.iterations();
  return qp.converged() ? StepStatus::kOptimal : StepStatus::kIterationLimit;
}

void explain(const LimitedProblem& problem, LimitedStep& step) noexcept {
  const auto n = static_cast<std::size_t>(problem.joints);
  for (std::size_t j = 0; j < n; ++j) {
    const auto k = static_cast<Eigen::Index>(j);
    const StepBox& box = problem.box;
    std::int8_t side = side_of(step.dq[k], box.lower[k], box.upper[k], 0.0);
    if (side == 1 && step.dq[k] <= box.lower[k] && box.lower[k] > 0.0) {
      side = -1;  // no choice, and away from the lower limit
    }
    step.active[j] = side;
    step.kinds[j] = side == 0 ? LimitKind::kNone : side > 0 ? box.upper_kind[j] : box.lower_kind[j];
  }
  step.count = problem.count;
  for (std::size_t i = 0; std::cmp_less(i, problem.count); ++i) {
    const LimitedProblem::Level& from = problem.levels[i];
    LimitedStep::Level& level = step.levels[i];
    const SmallVector moved = from.value.jacobian * step.dq;
    level.error = from.value.error;
    level.interval = from.interval;
    level.residual = from.interval ? moved - moved.cwiseMax(from.lower).cwiseMin(from.upper)
                                   : SmallVector(moved - from.wanted);
    level.active.fill(0);
    for (Eigen::Index row = 0; from.interval && row < moved.size(); ++row) {
      const double rounding = kAtBound * from.value.jacobian.row(row).norm() * step.dq.norm();
      level.active[static_cast<std::size_t>(row)] =
          side_of(moved[row], from.lower[row], from.upper[row], rounding);
    }
  }
  step.wheels.fill(0);
  for (Eigen::Index row = 0; row < problem.wheel_rows.rows(); ++row) {
    const double limit = problem.wheel_limit[row];
    step.wheels[static_cast<std::size_t>(row)] =
        side_of(problem.wheel_rows.row(row).dot(step.dq), -limit, limit, kAtBound * limit);
  }
}

}  // namespace thing_kin
