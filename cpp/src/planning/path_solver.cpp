#include "path_solver.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "thing_kin/kinematics/damped_inverse.hpp"
#include "thing_kin/kinematics/log_dexterity.hpp"
#include "thing_kin/kinematics/pose_curvature.hpp"
#include "thing_kin/kinematics/pose_error.hpp"
#include "thing_kin/linalg/row_qr.hpp"

namespace thing_kin {

namespace {

using ConstVector = Eigen::Map<const Eigen::VectorXd>;
using Vector = Eigen::Map<Eigen::VectorXd>;
using ConstMatrix = Eigen::Map<const Eigen::MatrixXd>;
using Matrix = Eigen::Map<Eigen::MatrixXd>;

constexpr double kOnPose = 1e-11;  // m and rad: a waypoint is on its pose
constexpr int kRetractions = 12;
constexpr double kRetractionDamping = 1e-11;  // of J J^T, whose trace is some 10
constexpr double kWorstDexterity = 30.0;      // log sqrt(kappa/M) is taken for no more: singular
constexpr double kFirstPointRadius = 1e-6;    // base discs smaller than this are points, m
constexpr double kLeastRadius = 0.02, kMostRadius = 1.0;
constexpr double kMostPenalty = 1e7;
constexpr double kStationary = 1e-9;  // relative decrease that is none
constexpr double kArmijo = 0.01;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

}  // namespace

PathSolver::PathSolver(const PathProblem& problem, int capacity)
    : problem_(problem),
      n_(problem.dof()),
      m_(problem.freedom()),
      clearances_(problem.clearances().size()),
      square_weights_(problem.joint_weights.cwiseAbs2()),
      qp_(std::max(1, m_)) {
  const auto most = index(capacity);
  const auto n = index(n_);
  const auto m = index(m_);
  const auto c = index(clearances_);
  goals_.reserve(most);
  for (auto* v :
       {&q_, &trial_, &dq_, &gradient_, &dexterity_gradient_, &lagrangian_, &linear_multiplier_}) {
    v->assign(most * n, 0.0);
  }
  Z_.assign(most * n * m, 0.0);
  dexterity_hessian_.assign(most * n * n, 0.0);
  curvature_.assign(most * m * m, 0.0);
  J_.resize(most);
  base_multiplier_.assign(most, 0.0);
  for (auto* v : {&values_, &trial_values_, &clearance_multiplier_, &inner_multiplier_}) {
    v->assign(most * c, 0.0);
  }
  const int rows = capacity * (4 * n_ + 8 + 2 * clearances_);
  refs_.reserve(index(rows));
  points_.reserve(index(capacity * clearances_));
  qp_.reserve(capacity, rows);
}

void PathSolver::set_goals(const std::vector<PathGoal>& goals) {
  goals_ = goals;
  forget();
}

void PathSolver::come_from(const double* from) {
  has_origin_ = from != nullptr;
  if (has_origin_) {
    origin_ = ConstVector(from, n_);
  }
}

void PathSolver::forget() noexcept {
  for (auto* v :
       {&linear_multiplier_, &base_multiplier_, &clearance_multiplier_, &inner_multiplier_}) {
    std::ranges::fill(*v, 0.0);
  }
  watched_.clear();
  damping_ = 0.0;
  radius_ = 0.5;
  last_decrease_ = 1.0;
}

void PathSolver::drop_first() noexcept {
  if (goals_.empty()) {
    return;
  }
  goals_.erase(goals_.begin());
  const auto shift = [](std::vector<double>& v, int stride) {
    std::copy(v.begin() + stride, v.end(), v.begin());
    std::fill(v.end() - stride, v.end(), 0.0);
  };
  shift(q_, n_);
  shift(linear_multiplier_, n_);
  shift(base_multiplier_, 1);
  shift(clearance_multiplier_, clearances_);
  shift(inner_multiplier_, clearances_);
}

void PathSolver::append(const PathGoal& goal, const double* from) noexcept {
  goals_.push_back(goal);  // within capacity
  std::copy_n(from, n_, q(count() - 1));
}

void PathSolver::watch(int k, int i, double t) { watched_.push_back({k, i, t, 0.0}); }

bool PathSolver::retract(const PathGoal& goal, double* q) const noexcept {
  const Chain& chain = problem_.chain();
  const JointVector mobility = JointVector::Ones(n_);
  const RowFactors identity;
  Posture posture;
  Jacobian J;
  JointVector step(n_);
  double last = kUnlimited;
  for (int i = 0; i < kRetractions; ++i) {
    place_joints(chain, q, posture);
    const Vector6 e = pose_error(frame_pose(chain, posture, problem_.frame()), goal.pose);
    const double norm = e.norm();
    if (norm < kOnPose) {
      return true;
    }
    if (!(norm < 4.0 * last)) {
      return false;
    }
    last = norm;
    geometric_jacobian(chain, posture, problem_.frame(), ReferenceFrame::kWorldAligned, J);
    damped_inverse(J, identity, mobility.data(), kRetractionDamping, e, step.data());
    const double longest = step.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(longest)) {
      return false;
    }
    Vector(q, n_) += std::min(1.0, 0.5 / longest) * step;
  }
  return last < 100.0 * kOnPose;
}

// (r^2 - |b - c|^2)/(2 r): smooth at the middle, and near the rim the distance from it.
double PathSolver::base_slack(int k, const double* at, double* gradient) const noexcept {
  const auto& base = *problem_.chain().base_joints();
  const PathGoal& goal = goals_[index(k)];
  const double r = problem_.base_radius - std::min(kMargin, 0.5 * problem_.base_radius);
  const double scale = std::max(r, kFirstPointRadius);
  double square = 0.0;
  for (const std::size_t i : {0U, 1U}) {
    const double way = at[base[i]] - goal.base[static_cast<Eigen::Index>(i)];
    square += way * way;
    if (gradient != nullptr) {
      gradient[i] = -way / scale;
    }
  }
  return 0.5 * (r * r - square) / scale;
}

PathSolver::Merit PathSolver::begin() noexcept {
  merit_ = evaluate(q_.data());
  std::swap(values_, trial_values_);
  return merit_;
}

double PathSolver::violation_of_first() noexcept {
  Merit merit;
  evaluate_waypoint(0, q(0), merit);
  merit.worst = 0.0;
  evaluate_waypoint(1, q(1), merit);
  evaluate_segment(0, q(0), merit);
  return merit.worst;
}

PathSolver::Merit PathSolver::evaluate(const double* q) noexcept {
  Merit merit;
  for (int k = 0; k < count(); ++k) {
    evaluate_waypoint(k, q + k * n_, merit);
    if (k > 0) {
      evaluate_segment(k - 1, q + (k - 1) * n_, merit);
    }
  }
  if (has_origin_ && fixed_ == 0) {
    const JointVector way = ConstVector(q, n_) - origin_;
    merit.objective += 0.5 * square_weights_.dot(way.cwiseAbs2());
  }
  for (const Watched& watched : watched_) {
    const double* a = q + watched.k * n_;
    const JointVector at =
        (1.0 - watched.t) * ConstVector(a, n_) + watched.t * ConstVector(a + n_, n_);
    Posture posture;
    place_joints(problem_.chain(), at.data(), posture);
    const double d = problem_.clearances().value(posture, at.data(), watched.i) - kMargin;
    merit.violation += std::max(0.0, -d);
    merit.worst = std::max(merit.worst, -d);
  }
  return merit;
}

void PathSolver::evaluate_waypoint(int k, const double* q, Merit& merit) noexcept {
  const Chain& chain = problem_.chain();
  const PathGoal& goal = goals_[index(k)];
  Posture posture;
  place_joints(chain, q, posture);
  if (problem_.dexterity_weight > 0.0) {
    Jacobian J;
    geometric_jacobian(chain, posture, problem_.frame(), ReferenceFrame::kWorldAligned, J);
    const double value = log_dexterity(J, problem_.column_weights.data());
    merit.objective += problem_.dexterity_weight * std::min(value, kWorstDexterity);
  }
  const bool counts = k >= fixed_;
  const auto miss = [&](double slack) {
    if (counts) {
      merit.violation += std::max(0.0, -slack);
      merit.worst = std::max(merit.worst, -slack);
    }
  };
  for (int j = 0; j < n_; ++j) {
    miss(std::min(q[j] - chain.lower()[j], chain.upper()[j] - q[j]) - kMargin);
  }
  if (problem_.has_base_path && problem_.base_radius < kUnlimited) {
    miss(base_slack(k, q, nullptr));
  }
  if (chain.base_joints()) {
    const double theta = q[(*chain.base_joints())[2]];
    miss(std::min(theta - goal.heading_lower, goal.heading_upper - theta) - kMargin);
  }
  double* values = trial_values_.data() + k * clearances_;
  for (int i = 0; i < clearances_; ++i) {
    values[i] = problem_.clearances().value(posture, q, i);
    miss(values[i] - kMargin);
  }
}

void PathSolver::evaluate_segment(int k, const double* q, Merit& merit) noexcept {
  const JointVector step = ConstVector(q + n_, n_) - ConstVector(q, n_);
  merit.objective += 0.5 * square_weights_.dot(step.cwiseAbs2());
  for (int j = 0; j < n_; ++j) {
    const double slack = step_bound(j) - std::abs(step[j]);
    merit.violation += std::max(0.0, -slack);
    merit.worst = std::max(merit.worst, -slack);
  }
  const double* from = trial_values_.data() + k * clearances_;
  for (int i = 0; i < clearances_; ++i) {
    const Inner inner = inner_minimum(q, q + n_, i, from[i], from[clearances_ + i]);
    if (inner.t > 0.0) {
      const double slack = inner.value - kMargin;
      merit.violation += std::max(0.0, -slack);
      merit.worst = std::max(merit.worst, -slack);
    }
  }
}

// Where a clearance is least within a segment, if that is between its ends: safeguarded secant on
// its slope.
PathSolver::Inner PathSolver::inner_minimum(const double* from, const double* to, int i,
                                            double d_from, double d_to) const noexcept {
  const JointVector dq = ConstVector(to, n_) - ConstVector(from, n_);
  constexpr double kReach = 2.0;  // m; the check at the end does not rely on it
  Inner best;
  if (d_from + d_to > kReach * dq.lpNorm<1>()) {
    return best;
  }
  Posture posture;
  JointVector gradient;
  JointVector at(n_);
  double value = 0.0;
  const auto slope = [&](double t) {
    at = ConstVector(from, n_) + t * dq;
    place_joints(problem_.chain(), at.data(), posture);
    value = problem_.clearances().gradient(posture, at.data(), i, gradient);
    return gradient.dot(dq);
  };
  double low = 0.0;
  double high = 1.0;
  double slope_low = slope(0.0);
  if (slope_low >= 0.0) {
    return best;
  }
  double slope_high = slope(1.0);
  if (slope_high <= 0.0) {
    return best;
  }
  constexpr int kProbes = 12;
  const double small = 1e-7 * (slope_high - slope_low);
  for (int probe = 0; probe < kProbes; ++probe) {
    double t = low - slope_low * (high - low) / (slope_high - slope_low);
    const double edge = 0.05 * (high - low);
    t = std::clamp(t, low + edge, high - edge);
    const double s = slope(t);
    best.t = t;
    best.value = value;
    if (std::abs(s) < small) {
      break;
    }
    (s < 0.0 ? low : high) = t;
    (s < 0.0 ? slope_low : slope_high) = s;
  }
  return best;
}

// Null spaces, the objective's derivatives.
void PathSolver::linearize() noexcept {
  for (int k = 0; k < count(); ++k) {
    linearize_waypoint(k);
  }
  for (int k = 0; k < count(); ++k) {
    Vector g(gradient_.data() + k * n_, n_);
    g = problem_.dexterity_weight * ConstVector(dexterity_gradient_.data() + k * n_, n_);
    if (k > 0) {
      g += square_weights_.cwiseProduct(ConstVector(q(k), n_) - ConstVector(q(k - 1), n_));
    } else if (has_origin_) {
      g += square_weights_.cwiseProduct(ConstVector(q(k), n_) - origin_);
    }
    if (k + 1 < count()) {
      g -= square_weights_.cwiseProduct(ConstVector(q(k + 1), n_) - ConstVector(q(k), n_));
    }
  }
}

void PathSolver::linearize_waypoint(int k) noexcept {
  const Chain& chain = problem_.chain();
  Posture posture;
  place_joints(chain, q(k), posture);
  Jacobian& J = J_[index(k)];
  geometric_jacobian(chain, posture, problem_.frame(), ReferenceFrame::kWorldAligned, J);
  SmallMatrix A = J;
  RowQr qr;
  qr.factor(A);
  SmallMatrix null;
  qr.null_space(null);
  Matrix(Z_.data() + k * n_ * m_, n_, m_) = null;
  Vector g(dexterity_gradient_.data() + k * n_, n_);
  Matrix H(dexterity_hessian_.data() + k * n_ * n_, n_, n_);
  LogDexterity dexterity;
  if (problem_.dexterity_weight > 0.0 &&
      log_dexterity(chain, J, problem_.column_weights.data(), dexterity) &&
      dexterity.value < kWorstDexterity) {
    g = dexterity.gradient;
    H = dexterity.hessian;
  } else {
    g.setZero();
    H.setZero();
  }
}

void PathSolver::add_linear(int k, int j, double sign, double slack) noexcept {
  if (k < fixed_ || !(slack < std::sqrt(static_cast<double>(m_)) * radius_)) {
    return;
  }
  double* a = qp_.add_row(stage(k), slack, rho_);
  for (int c = 0; c < m_; ++c) {
    a[c] = sign * Z(k)[c * n_ + j];
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
      a[c] = g[0] * Z(k)[c * n_ + base[0]] + g[1] * Z(k)[c * n_ + base[1]];
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
  const bool within = kind != Kind::kClearance;
  if (!within && !(values_[index(k * clearances_ + i)] < kReach * radius_) && z == 0.0) {
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
      a[c] = share * gradient.dot(ConstVector(Z(waypoint) + c * n_, n_));
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
          a[c] = sign * Z(k)[c * n_ + j];
        }
        a[(stage(k + 1) - first) * m_ + c] = -sign * Z(k + 1)[c * n_ + j];
      }
      refs_.push_back({Kind::kStep, k, j, sign});
    }
  }
  for (int i = 0; i < clearances_; ++i) {
    const Inner inner = inner_minimum(q(k), q(k + 1), i, values_[index(k * clearances_ + i)],
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

// H, g and E of the joints' steps, and g of the dexterity.
void PathSolver::add_objective() noexcept {
  for (int k = fixed_; k < count(); ++k) {
    const ConstMatrix Zk(Z(k), n_, m_);
    Vector(qp_.g(stage(k)), m_) =
        Zk.transpose().lazyProduct(ConstVector(gradient_.data() + k * n_, n_));
    const int sides = (k > 0 || has_origin_ ? 1 : 0) + (k + 1 < count() ? 1 : 0);
    for (int a = 0; a < m_; ++a) {
      for (int b = 0; b < m_; ++b) {
        double same = 0.0;
        double next = 0.0;
        for (int j = 0; j < n_; ++j) {
          const double left = square_weights_[j] * Z(k)[a * n_ + j];
          same += left * Z(k)[b * n_ + j];
          next += k + 1 < count() ? left * Z(k + 1)[b * n_ + j] : 0.0;
        }
        qp_.H(stage(k))[b * m_ + a] = sides * same;
        qp_.E(stage(k))[b * m_ + a] = -next;
      }
    }
  }
}

void PathSolver::project(int k, const SmallMatrix& H, double* out, bool convex) const noexcept {
  const ConstMatrix Zk(Z(k), n_, m_);
  SmallMatrix HZ(n_, m_);
  HZ.noalias() = H.lazyProduct(Zk);
  SmallMatrix block(m_, m_);
  block.noalias() = Zk.transpose().lazyProduct(HZ);
  if (convex) {
    const Eigen::SelfAdjointEigenSolver<SmallMatrix> eigen(block);
    const SmallVector values = eigen.eigenvalues().cwiseMax(0.0);
    block = eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
  }
  Matrix(out, m_, m_) += 0.5 * (block + block.transpose());
}

// Second derivatives of the Lagrangian beyond those of the joints' steps: dexterity, constraints by
// their multipliers, the poses by theirs.
void PathSolver::add_curvature(bool convex) noexcept {
  const Chain& chain = problem_.chain();
  std::size_t next = 0;
  SmallMatrix H(n_, n_);
  for (int k = 0; k < count(); ++k) {
    if (k >= fixed_) {
      H = problem_.dexterity_weight * ConstMatrix(dexterity_hessian_.data() + k * n_ * n_, n_, n_);
      const Jacobian& J = J_[index(k)];
      Matrix6 gram;
      gram.noalias() = J.lazyProduct(J.transpose());
      gram.diagonal().array() += kRetractionDamping;
      const Vector6 right = J.lazyProduct(ConstVector(lagrangian_.data() + k * n_, n_));
      const Vector6 y = gram.llt().solve(right);
      if (y.allFinite()) {
        add_pose_curvature(chain, J, -y, H);
      }
      const double z = base_multiplier_[index(k)];
      if (z > 0.0) {
        const auto& base = *chain.base_joints();
        const double r = std::max(problem_.base_radius, kFirstPointRadius);
        H(base[0], base[0]) += z / r;
        H(base[1], base[1]) += z / r;
      }
    }
    // Those at the waypoint come first, then those of the segment behind it.
    for (; next < points_.size() && points_[next].k == k && points_[next].t < 0.0; ++next) {
      Posture posture;
      place_joints(chain, q(k), posture);
      problem_.clearances().add_hessian(posture, q(k), points_[next].i, -points_[next].z, H);
    }
    if (k >= fixed_) {
      project(k, H, qp_.H(stage(k)), convex);
    }
    for (; next < points_.size() && points_[next].k == k; ++next) {
      add_point_curvature(points_[next], convex);
    }
  }
}

// A clearance's minimum within a segment moves along it: d(q(t)) has the slope s = grad d . dq by
// t, and at the minimum the second derivative is that at fixed t less ds ds^T/(d^2 d/dt^2).
void PathSolver::add_point_curvature(const PointRow& point, bool convex) noexcept {
  const int k = point.k;
  const JointVector dq = ConstVector(q(k + 1), n_) - ConstVector(q(k), n_);
  const JointVector at = ConstVector(q(k), n_) + point.t * dq;
  Posture posture;
  JointVector gradient;
  place_joints(problem_.chain(), at.data(), posture);
  problem_.clearances().gradient(posture, at.data(), point.i, gradient);
  SmallMatrix C = SmallMatrix::Zero(n_, n_);
  problem_.clearances().add_hessian(posture, at.data(), point.i, 1.0, C);
  const JointVector bend = C.lazyProduct(dq);
  const double curvature = dq.dot(bend);
  const double share = curvature > 0.0 ? point.z / curvature : 0.0;
  C *= -point.z;
  SmallMatrix CZ(n_, m_);
  SmallVector slopes[2];
  for (int side = 0; side < 2; ++side) {
    const double part = side == 0 ? 1.0 - point.t : point.t;
    const ConstMatrix Zs(Z(k + side), n_, m_);
    const JointVector ds = part * bend + (side == 0 ? -1.0 : 1.0) * gradient;
    slopes[side] = Zs.transpose().lazyProduct(ds);
    if (k + side < fixed_) {
      continue;
    }
    Matrix H(qp_.H(stage(k + side)), m_, m_);
    H.noalias() += share * slopes[side].lazyProduct(slopes[side].transpose());
    if (!convex) {
      CZ.noalias() = C.lazyProduct(Zs);
      H.noalias() += part * part * Zs.transpose().lazyProduct(CZ);
    }
  }
  if (k >= fixed_) {  // CZ is that of the second side
    Matrix E(qp_.E(stage(k)), m_, m_);
    E.noalias() += share * slopes[0].lazyProduct(slopes[1].transpose());
    if (!convex) {
      E.noalias() +=
          point.t * (1.0 - point.t) * ConstMatrix(Z(k), n_, m_).transpose().lazyProduct(CZ);
    }
  }
}

// Builds and solves the quadratic program; its decrease, or a negative number if it broke down.
double PathSolver::solve_model() noexcept {
  qp_.reset(count() - fixed_);
  add_rows();
  add_objective();
  add_curvature(false);
  if (!qp_.is_convex(damping_)) {
    add_objective();  // anew: what is added below is positive semidefinite
    add_curvature(true);
  }
  const double share = last_decrease_ / std::max(1.0, static_cast<double>(qp_.rows()));
  const double mu = std::clamp(share, 1e-9, 1e-2 * rho_);
  if (!qp_.solve(std::max(damping_, 1e-12), mu)) {
    return -1.0;
  }
  return qp_.decrease();
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

bool PathSolver::move_to_trial(double alpha) noexcept {
  for (int k = 0; k < count(); ++k) {
    Vector at(trial_.data() + k * n_, n_);
    at = ConstVector(q(k), n_) + alpha * ConstVector(dq_.data() + k * n_, n_);
    if (k >= fixed_ && !retract(goals_[index(k)], at.data())) {
      return false;
    }
  }
  return true;
}

// Backtracking on the exact l1 merit.
bool PathSolver::try_steps(double decrease, double longest) noexcept {
  const double before = merit_.objective + rho_ * merit_.violation;
  const double most = std::min(1.0, radius_ / std::max(longest, 1e-300));
  double alpha = most;
  constexpr int kTrials = 6;
  for (int i = 0; i < kTrials; ++i) {
    if (move_to_trial(alpha)) {
      const Merit merit = evaluate(trial_.data());
      const double after = merit.objective + rho_ * merit.violation;
      const double noise = 1e-15 * (1.0 + std::abs(before));
      if (after <= before - kArmijo * alpha * decrease + noise) {
        merit_ = merit;
        std::swap(q_, trial_);
        std::swap(values_, trial_values_);
        const double moved = alpha * longest;
        radius_ =
            alpha < most ? 1.5 * moved : std::max(std::min(radius_, 4.0 * moved), 2.0 * moved);
        radius_ = std::clamp(radius_, kLeastRadius, kMostRadius);
        damping_ = alpha == 1.0 ? (damping_ < 1e-6 ? 0.0 : 0.1 * damping_) : damping_;
        all_rows_ = alpha < most;
        return true;
      }
    }
    alpha *= 0.4;
  }
  damping_ = std::max(10.0 * damping_, 1e-4);
  all_rows_ = true;
  return false;
}

PathSolver::Outcome PathSolver::iterate() noexcept {
  if (m_ == 0 || count() <= fixed_) {
    return merit_.worst <= kFeasible ? Outcome::kConverged : Outcome::kStationary;
  }
  linearize();
  constexpr int kDampings = 8;
  for (int attempt = 0; attempt < kDampings; ++attempt) {
    const double decrease = solve_model();
    if (decrease < -1e-12) {
      damping_ = std::max(10.0 * damping_, 1e-4);
      continue;
    }
    double longest = 0.0;
    for (int k = fixed_; k < count(); ++k) {
      Vector dq(dq_.data() + k * n_, n_);
      dq.noalias() = ConstMatrix(Z(k), n_, m_).lazyProduct(ConstVector(qp_.p(stage(k)), m_));
      longest = std::max(longest, dq.lpNorm<Eigen::Infinity>());
    }
    const double scale = 1e-3 + std::abs(merit_.objective);
    const bool stationary = decrease < kStationary * scale;
    if (stationary && merit_.worst > kFeasible) {
      if (rho_ >= kMostPenalty) {
        return Outcome::kStationary;
      }
      rho_ *= 30.0;
      continue;
    }
    keep_multipliers();
    last_decrease_ = std::max(decrease, 0.0);
    if (stationary) {
      return Outcome::kConverged;
    }
    if (try_steps(decrease, longest)) {
      return Outcome::kStepped;
    }
  }
  return merit_.worst <= kFeasible ? Outcome::kConverged : Outcome::kStationary;
}

}  // namespace thing_kin
