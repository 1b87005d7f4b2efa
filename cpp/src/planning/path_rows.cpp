#include <algorithm>
#include <cmath>

#include "path_maps.hpp"
#include "path_solver.hpp"

namespace thing_kin {

using namespace path;

void PathSolver::add_linear(int k, int j, double sign, double slack) noexcept {
  if (k < fixed_ || !(slack < std::sqrt(static_cast<double>(m_)) * radius_)) {
    return;
  }
  double* a = qp_.add_row(stage(k), slack, rho_);
  for (int c = 0; c < m_; ++c) {
    a[c] = sign * basis(k)[c * n_ + j];
  }
  refs_.push_back({Kind::kLinear, k, j, sign});
}

void PathSolver::add_waypoint_rows(int k) noexcept {
  const Chain& chain = problem_.chain();
  const PathGoal& goal = goals_[index(k)];
  if (k < fixed_) {
    return;
  }
  for (int j = 0; j < n_; ++j) {
    add_linear(k, j, 1.0, q(k)[j] - chain.lower()[j] - kMargin);
    add_linear(k, j, -1.0, chain.upper()[j] - q(k)[j] - kMargin);
  }
  if (chain.base_joints()) {
    const int theta = (*chain.base_joints())[2];
    add_linear(k, theta, 1.0, q(k)[theta] - goal.heading_lower - kMargin);
    add_linear(k, theta, -1.0, goal.heading_upper - q(k)[theta] - kMargin);
  }
  Vector L(lagrangian_.data() + k * n_, n_);
  if (problem_.has_base_path && problem_.base_radius < kUnlimited) {
    const auto& base = *chain.base_joints();
    double g[2];
    const double slack = base_slack(k, q(k), g);
    double* a = qp_.add_row(stage(k), slack, rho_);
    for (int c = 0; c < m_; ++c) {
      a[c] = g[0] * basis(k)[c * n_ + base[0]] + g[1] * basis(k)[c * n_ + base[1]];
    }
    refs_.push_back({Kind::kBase, k, 0, 1.0});
    const double z = base_multiplier_[index(k)];
    L[base[0]] -= z * g[0];
    L[base[1]] -= z * g[1];
  }
  for (int i = 0; i < clearances_; ++i) {
    add_point_row(Kind::kClearance, k, i, 0.0, clearance_multiplier_[index(k * clearances_ + i)]);
  }
}

// A clearance at a waypoint (t = 0), or at the point t of the segment behind it.
void PathSolver::add_point_row(Kind kind, int k, int i, double t, double z) noexcept {
  constexpr double kReach = 3.0;  // m: what a joint's turn may bring a sphere nearer by
  constexpr double kNear = 0.15;  // m: what is further away the merit watches
  const bool within = kind != Kind::kClearance;
  const double near = all_rows_ ? kReach * radius_ : std::min(kReach * radius_, kNear);
  if (!within && !(values_[index(k * clearances_ + i)] < near) && z == 0.0) {
    return;
  }
  JointVector at = ConstVector(q(k), n_);
  if (within) {
    at = (1.0 - t) * at + t * ConstVector(q(k + 1), n_);
  }
  Posture posture;
  JointVector gradient;
  place_joints(problem_.chain(), at.data(), posture);
  const double slack = problem_.clearances().gradient(posture, at.data(), i, gradient) - kMargin;
  const int first = std::max(stage(k), 0);
  double* row = qp_.add_row(first, slack, rho_);
  for (int side = 0; side < (within ? 2 : 1); ++side) {
    const int waypoint = k + side;
    const double share = side == 0 ? 1.0 - t : t;
    if (waypoint < fixed_) {
      continue;
    }
    double* a = row + (stage(waypoint) - first) * m_;
    for (int c = 0; c < m_; ++c) {
      a[c] = share * gradient.dot(ConstVector(basis(waypoint) + c * n_, n_));
    }
    Vector(lagrangian_.data() + waypoint * n_, n_) -= share * z * gradient;
  }
  refs_.push_back({kind, k, i, t});
  if (z > 0.0 && kind != Kind::kWatched) {
    points_.push_back({k, i, within ? t : -1.0, z});
  }
}

void PathSolver::add_segment_rows(int k) noexcept {
  const double reach = 2.0 * std::sqrt(static_cast<double>(m_)) * radius_;
  for (int j = 0; j < n_; ++j) {
    const double bound = step_bound(j);
    const double step = q(k + 1)[j] - q(k)[j];
    const double near = all_rows_ ? reach : std::min(reach, 0.5 * bound);
    for (const double sign : {1.0, -1.0}) {
      const double slack = bound - sign * step;
      if (!(slack < near)) {  // what is left out the merit watches
        continue;
      }
      const int first = std::max(stage(k), 0);
      double* a = qp_.add_row(first, slack, rho_);
      for (int c = 0; c < m_; ++c) {
        if (k >= fixed_) {
          a[c] = sign * basis(k)[c * n_ + j];
        }
        a[(stage(k + 1) - first) * m_ + c] = -sign * basis(k + 1)[c * n_ + j];
      }
      refs_.push_back({Kind::kStep, k, j, sign});
    }
  }
  for (int i = 0; i < clearances_; ++i) {
    const Inner inner = inner_minimum(k, q(k), i, values_[index(k * clearances_ + i)],
                                      values_[index((k + 1) * clearances_ + i)]);
    if (inner.t > 0.0) {
      add_point_row(Kind::kInner, k, i, inner.t, inner_multiplier_[index(k * clearances_ + i)]);
    }
  }
}

void PathSolver::add_rows() noexcept {
  refs_.clear();
  points_.clear();
  for (int k = 0; k < count(); ++k) {
    Vector(lagrangian_.data() + k * n_, n_) = ConstVector(gradient_.data() + k * n_, n_) -
                                              ConstVector(linear_multiplier_.data() + k * n_, n_);
  }
  for (int k = 0; k < count(); ++k) {
    add_waypoint_rows(k);
    if (k + 1 < count()) {
      add_segment_rows(k);
    }
  }
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const Watched& w = watched_[i];
    add_point_row(Kind::kWatched, w.k, w.i, w.t, w.multiplier);
    refs_.back().i = static_cast<int>(i);
  }
}

void PathSolver::keep_multipliers() noexcept {
  for (auto* v :
       {&linear_multiplier_, &base_multiplier_, &clearance_multiplier_, &inner_multiplier_}) {
    std::ranges::fill(*v, 0.0);
  }
  for (int i = 0; i < qp_.rows(); ++i) {
    const Ref& ref = refs_[index(i)];
    const double z = qp_.multiplier(i);
    switch (ref.kind) {
      case Kind::kLinear:
        linear_multiplier_[index(ref.k * n_ + ref.i)] += ref.sign * z;
        break;
      case Kind::kStep:
        linear_multiplier_[index(ref.k * n_ + ref.i)] += ref.sign * z;
        linear_multiplier_[index((ref.k + 1) * n_ + ref.i)] -= ref.sign * z;
        break;
      case Kind::kBase:
        base_multiplier_[index(ref.k)] = z;
        break;
      case Kind::kClearance:
        clearance_multiplier_[index(ref.k * clearances_ + ref.i)] = z;
        break;
      case Kind::kInner:
        inner_multiplier_[index(ref.k * clearances_ + ref.i)] = z;
        break;
      case Kind::kWatched:
        watched_[index(ref.i)].multiplier = z;
        break;
    }
  }
}

}  // namespace thing_kin
