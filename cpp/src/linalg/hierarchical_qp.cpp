#include "thing_kin/linalg/hierarchical_qp.hpp"

#include <algorithm>
#include <cmath>

#include "thing_kin/linalg/interval_search.hpp"
#include "thing_kin/linalg/small_product.hpp"

namespace thing_kin {

namespace {

// A constraint blocks a direction if it changes by more than this part of its length. What is left
// out moves by less than rounding allows for, and the working set stays well conditioned.
constexpr double kLeastSlope = 1e-11;
// A constraint from the level above is held from the start if so much of it is still free.
constexpr double kLeastWarm = 1e-8;
// Rounding of a gradient, of a residual: parts of the numbers that they are the difference of.
constexpr double kGradientRounding = 1e-12;
constexpr double kResidualRounding = 1e-13;
constexpr double kStationary = 1e-12;

}  // namespace

// A constraint's row: of the box first, then of the intervals kept.
double HierarchicalQp::value(int row) const {
  const auto n = static_cast<int>(x_.size());
  return row < n ? x_[row] : rows_.col(row - n).dot(x_);
}

double HierarchicalQp::bound(int row, int side) const {
  const auto n = static_cast<int>(x_.size());
  const auto i = static_cast<std::size_t>(row - n);
  return row < n ? (side > 0 ? upper_ : lower_)[row] : (side > 0 ? row_upper_ : row_lower_)[i];
}

double HierarchicalQp::slope(int row, const JointVector& d) const {
  const auto n = static_cast<int>(x_.size());
  return row < n ? d[row] : rows_.col(row - n).dot(d);
}

void HierarchicalQp::along_basis(int row, SmallVector& along) const {
  const auto n = static_cast<int>(x_.size());
  const SmallMatrix& Q = working_.basis();
  if (row < n) {
    along = Q.row(row).transpose();
  } else {
    along.noalias() = Q.transpose() * rows_.col(row - n);
  }
}

void HierarchicalQp::hold(const WorkingSet::Entry& entry, double least) {
  SmallVector along;
  along_basis(entry.row, along);
  if (working_.add(entry, along, least)) {
    state_[static_cast<std::size_t>(entry.row)] = State::kHeld;
  }
}

void HierarchicalQp::begin(const JointVector& lower, const JointVector& upper,
                           const JointVector& guess) noexcept {
  const auto n = static_cast<int>(lower.size());
  lower_ = lower;
  upper_ = upper;
  x_ = guess.cwiseMax(lower).cwiseMin(upper);
  count_ = kept_count_ = iterations_ = 0;
  rows_.resize(n, kMaxIntervalRows);
  converged_ = true;
  Z_.setIdentity(n, n);
  for (int i = 0; i < n; ++i) {
    state_[static_cast<std::size_t>(i)] = State::kInactive;
    if (x_[i] == upper[i] || x_[i] == lower[i]) {
      kept_[static_cast<std::size_t>(kept_count_++)] = {i, x_[i] == upper[i] ? 1 : -1};
    }
  }
}

void HierarchicalQp::warm_start() {
  working_.reset(Z_);
  for (int row = 0; row < constraints(); ++row) {
    State& state = state_[static_cast<std::size_t>(row)];
    state = state == State::kHeld ? State::kInactive : state;
  }
  for (int i = 0; i < kept_count_; ++i) {
    hold(kept_[static_cast<std::size_t>(i)], kLeastWarm);
  }
}

void HierarchicalQp::miss(const Level& level, Residual& residual) const {
  SmallVector at = SmallVector::Zero(level.K.rows());
  accumulate(1.0, level.K, x_, at);
  if (level.equalities) {
    residual.missed = at - level.lower;
    return;
  }
  const Eigen::Index m = at.size();
  residual.all = at - at.cwiseMax(level.lower).cwiseMin(level.upper);
  residual.rows.resize(m, x_.size());
  residual.missed.resize(m);
  Eigen::Index missing = 0;
  for (Eigen::Index i = 0; i < m; ++i) {
    const double rounding = level.K.row(i).norm() * x_.norm() + std::abs(at[i]);
    if (std::abs(residual.all[i]) <= kResidualRounding * rounding) {
      residual.all[i] = 0.0;
      continue;
    }
    residual.rows.row(missing) = level.K.row(i);
    residual.missed[missing++] = residual.all[i];
  }
  residual.rows.conservativeResize(missing, Eigen::NoChange);
  residual.missed.conservativeResize(missing);
}

// The first constraint in the way of x + alpha d and where; -1 if none.
int HierarchicalQp::first_block(const JointVector& d, double& alpha) const {
  const double least = kLeastSlope * d.norm();
  int block = -1;
  for (int row = 0; row < constraints(); ++row) {
    if (state_[static_cast<std::size_t>(row)] != State::kInactive) {
      continue;
    }
    const double s = slope(row, d);
    if (std::abs(s) <= least) {
      continue;
    }
    const double room = std::max(0.0, (bound(row, s > 0.0 ? 1 : -1) - value(row)) / s);
    if (room < alpha) {
      alpha = room;
      block = row;
    }
  }
  return block;
}

// A step towards the minimum on the face that is free. False if it has been reached.
bool HierarchicalQp::descend(const Level& level, const Residual& residual) {
  if (working_.free() == 0) {
    return false;
  }
  SmallMatrix M;
  multiply(residual.matrix(level), working_.free_basis(), M);
  SmallVector t;
  if (level.orthonormal) {
    t.noalias() = M.transpose() * -residual.missed;
  } else {
    least_squares(M, -residual.missed, level.scale, t);
  }
  JointVector d = JointVector::Zero(x_.size());
  accumulate(1.0, working_.free_basis(), t, d);
  double alpha = 1.0;
  if (!level.equalities) {
    const double rounding = level.scale * x_.norm() + residual.missed.norm();
    if ((M * t).norm() <= kStationary * rounding) {
      return false;  // which way the kinks lie from here is rounding
    }
    alpha = interval_search(level.K * x_, level.K * d, level.lower, level.upper);
  }
  const bool whole = std::abs(alpha - 1.0) < 1e-9;
  const int block = first_block(d, alpha);
  x_ += alpha * d;
  if (block < 0) {
    return !whole;
  }
  const int side = slope(block, d) > 0.0 ? 1 : -1;
  if (block < x_.size()) {
    x_[block] = bound(block, side);
  }
  hold({block, side}, 0.0);
  return true;
}

double HierarchicalQp::tolerance(const Level& level, const Residual& residual) const {
  return kGradientRounding * level.scale * (level.scale * x_.norm() + residual.missed.norm());
}

// How much a constraint presses on the level, negative if it holds it back for nothing. One without
// width presses either way.
double HierarchicalQp::pull_of(int i) const {
  const WorkingSet::Entry& entry = working_[i];
  const bool narrow = !(bound(entry.row, -1) < bound(entry.row, 1));
  return narrow ? std::abs(mu_[i]) : entry.side * mu_[i];
}

// Drops the constraint that pulls the wrong way; false if none does. `cautious`: the first instead
// of the worst (Bland's rule), which can't go round in circles.
bool HierarchicalQp::drop_one(const Level& level, const Residual& residual, bool cautious) {
  const JointVector gradient = residual.matrix(level).transpose() * residual.missed;
  const SmallVector along = working_.basis().transpose() * gradient;
  working_.multipliers(along, mu_);
  int worst = -1;
  double least = -tolerance(level, residual);
  for (int i = 0; i < working_.size(); ++i) {
    const double pull = pull_of(i);
    if (cautious ? pull < -tolerance(level, residual) &&
                       (worst < 0 || working_[i].row < working_[worst].row)
                 : pull < least) {
      least = pull;
      worst = i;
    }
  }
  if (worst < 0) {
    return false;
  }
  state_[static_cast<std::size_t>(working_[worst].row)] = State::kInactive;
  working_.drop(worst);
  return true;
}

void HierarchicalQp::solve(Level& level, Residual& residual) noexcept {
  level.scale = level.K.norm();
  warm_start();
  const int cautious = 2 * constraints();
  const int most = 10 * constraints() + 50;
  for (int i = 0; i < most; ++i) {
    miss(level, residual);
    if (residual.missed.size() == 0) {  // all in their intervals
      mu_.setZero(working_.size());
      return;
    }
    ++iterations_;
    if (descend(level, residual)) {
      continue;
    }
    miss(level, residual);
    if (!drop_one(level, residual, i > cautious)) {
      return;
    }
  }
  converged_ = false;
  mu_.setZero(working_.size());
  miss(level, residual);
}

// Takes from the free space what this level needs: the constraints that press on it, which every
// solution as good has to keep, and its rows.
void HierarchicalQp::leave(const Level& level, const Residual& residual,
                           const RegularizedRows* rows) {
  const double least = tolerance(level, residual);
  std::array<WorkingSet::Entry, kMaxDof> pressing;
  int count = 0;
  kept_count_ = 0;
  for (int i = 0; i < working_.size(); ++i) {
    if (pull_of(i) > least) {
      pressing[static_cast<std::size_t>(count++)] = working_[i];
    } else {
      kept_[static_cast<std::size_t>(kept_count_++)] = working_[i];
    }
  }
  SmallMatrix V2;
  if (count == 0 && rows != nullptr) {
    rows->null_space(V2);
    SmallMatrix below;
    multiply(Z_, V2, below);
    Z_ = below;
    return;
  }
  working_.reset(Z_);
  for (int i = 0; i < count; ++i) {
    hold(pressing[static_cast<std::size_t>(i)], 0.0);
    state_[static_cast<std::size_t>(pressing[static_cast<std::size_t>(i)].row)] = State::kFixed;
  }
  const SmallMatrix N = working_.free_basis();
  RegularizedRows left;
  SmallMatrix M;
  multiply(residual.matrix(level), N, M);
  left.factor(M, level.scale, {});
  left.null_space(V2);
  multiply(N, V2, Z_);
}

// The rows of an interval level that hold are kept from here on; those that can't are fixed
// already. Rounding may have put one outside by as much: its bound gives way.
void HierarchicalQp::remember(const Level& level, const Residual& residual) {
  for (Eigen::Index i = 0; i < level.K.rows() && count_ < kMaxIntervalRows; ++i) {
    const double length = level.K.row(i).norm();
    if (residual.all[i] != 0.0 || !(length > 0.0)) {
      continue;
    }
    const auto k = static_cast<std::size_t>(count_);
    rows_.col(count_) = level.K.row(i).transpose() / length;
    const double at = rows_.col(count_).dot(x_);
    row_lower_[k] = std::min(level.lower[i] / length, at);
    row_upper_[k] = std::max(level.upper[i] / length, at);
    const int row = constraints();
    state_[static_cast<std::size_t>(row)] = State::kInactive;
    ++count_;
    if ((at == row_lower_[k] || at == row_upper_[k]) && kept_count_ < kMaxDof) {
      kept_[static_cast<std::size_t>(kept_count_++)] = {row, at == row_upper_[k] ? 1 : -1};
    }
  }
}

void HierarchicalQp::keep(const SmallMatrix& C, const SmallVector& lower,
                          const SmallVector& upper) noexcept {
  if (free() == 0) {
    return;
  }
  Level level{C, lower, upper, false, false, 0.0};
  Residual residual;
  solve(level, residual);
  leave(level, residual, nullptr);
  remember(level, residual);
}

void HierarchicalQp::minimize(const SmallMatrix& A, const SmallVector& b,
                              const Regularization& regularization) noexcept {
  if (free() == 0) {
    return;
  }
  SmallMatrix M;
  multiply(A, Z_, M);
  RegularizedRows rows;
  rows.factor(M, A.norm(), regularization);
  const SmallVector z = Z_.transpose() * x_;
  const SmallVector r = b - A * x_ + M * z;
  SmallMatrix K;
  Level level;
  rows.square_root(M, r, K, level.lower);
  multiply(K, Z_.transpose(), level.K);
  Residual residual;
  solve(level, residual);
  leave(level, residual, &rows);
}

void HierarchicalQp::nearest_to(const JointVector& z) noexcept {
  if (free() == 0) {
    return;
  }
  Level level;
  level.K = Z_.transpose();
  level.lower.noalias() = level.K * z;
  level.orthonormal = true;
  Residual residual;
  solve(level, residual);
}

void HierarchicalQp::finish() noexcept {
  for (Eigen::Index i = 0; i < x_.size(); ++i) {
    if (state_[static_cast<std::size_t>(i)] != State::kInactive) {
      x_[i] = upper_[i] - x_[i] < x_[i] - lower_[i] ? upper_[i] : lower_[i];
    }
  }
  x_ = x_.cwiseMax(lower_).cwiseMin(upper_);
}

}  // namespace thing_kin
