#include "pose_descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Eigenvalues>

#include "thing_kin/kinematics/pose_curvature.hpp"

namespace thing_kin {

namespace {

// The trust region, rad and m of any joint.
constexpr double kFirstRadius = 0.5;
constexpr double kLargestRadius = 1.5;
constexpr double kLeastRadius = 1e-7;

// A step this short, or of so little gain, with exact second derivatives leaves an error of its
// square.
constexpr double kLastStep = 3e-4;
constexpr double kLastGain = 1e-7;

// A step without them is one of many, each a fraction of the one before.
constexpr double kLeastGain = 1e-12;

// Shorter steps change nothing.
constexpr double kNoStep = 1e-10;

// Accept and enlarge: the fraction of the predicted gain that came true.
constexpr double kAccept = 0.05;
constexpr double kEnlarge = 0.7;

// A descent is given up if this many times the gain of Newton's step would not make it the best.
constexpr double kHope = 4.0;

// Curvature below this fraction of the largest is taken for it, so that the program is convex.
constexpr double kLeastCurvature = 1e-6;

constexpr double kFirstPenalty = 5.0;

// At its end a descent has the hand at the target within this, m and rad.
constexpr double kOnTarget = 1e-11;
constexpr int kMostReturns = 12;

// On the way it may miss by what is worth this fraction of the step's gain, and never by more than
// kLargestMiss: Newton's next correction squares it.
constexpr double kMissWorth = 0.01;
constexpr double kLargestMiss = 1e-3;

// What a metre of violation costs a start, beside log sqrt(kappa/M).
constexpr double kViolationPrice = 10.0;

double on_target(const SE3& target) { return kOnTarget * (1.0 + target.translation.norm()); }

template <typename Matrix>
Matrix with_sizes_of_curvature(const Matrix& H) noexcept {
  const Eigen::Index k = H.rows();
  // Loops, and the solver in two steps: GCC 12 takes Eigen's own for reading what is not set.
  Eigen::SelfAdjointEigenSolver<Matrix> solver(k);
  solver.compute(H);
  double largest = 0.0;
  for (Eigen::Index i = 0; i < k; ++i) {
    largest = std::max(largest, std::abs(solver.eigenvalues()[i]));
  }
  const double least = std::max(kLeastCurvature * largest, 1e-12);
  Matrix sum = Matrix::Zero(k, k);
  for (Eigen::Index i = 0; i < k; ++i) {
    const auto v = solver.eigenvectors().col(i);
    sum += std::max(std::abs(solver.eigenvalues()[i]), least) * v * v.transpose();
  }
  return sum;
}

IkProblem make_ik(const PosePlanner& planner, const JointBox& box, const Reach& reach,
                  const SE3& target) {
  const double length = reach.length() > 0.0 ? 0.3 * reach.length() : 1.0;
  const double tolerance = on_target(target);
  return {planner.chain(),
          planner.frame(),
          PoseResidual(target, PoseWeights{}, length),
          box,
          JointVector::Ones(planner.chain().dof()),
          tolerance,
          tolerance};
}

}  // namespace

PoseDescent::PoseDescent(const PosePlanner& planner, const SE3& target)
    : planner_(planner), ik_(make_ik(planner, planner.box_, planner.reach_, target)) {
  const int n = planner.chain_.dof();
  const int count = planner.clearances_.size() + (planner.options_.base_goal ? 1 : 0);
  for (PosePoint* point : {here_, there_}) {
    point->slack.resize(count);
  }
  forms_.resize(n, n + count + 1);
  lower_.resize(n + count + 1);
  upper_.resize(n + count + 1);
  mu_.resize(count);
  inequalities_.reserve(static_cast<std::size_t>(count));
  gradients_.resize(static_cast<std::size_t>(count));
}

// The base's disc as (R^2 - d^2)/(2 R), which has derivatives at its middle too and at its rim the
// slope of a distance; then the clearances.
double PoseDescent::slack_gradient(const PosePoint& point, int i,
                                   JointVector& gradient) const noexcept {
  const PosePlanOptions& options = planner_.options_;
  if (!options.base_goal) {
    return planner_.clearances_.gradient(point.posture, point.q.data(), i, gradient);
  }
  if (i > 0) {
    return planner_.clearances_.gradient(point.posture, point.q.data(), i - 1, gradient);
  }
  const auto& base = *planner_.chain_.base_joints();
  const double R = options.base_radius;
  const Eigen::Vector2d way(point.q[base[0]] - options.base_goal->x(),
                            point.q[base[1]] - options.base_goal->y());
  gradient = JointVector::Zero(point.q.size());
  gradient[base[0]] = -way.x() / R;
  gradient[base[1]] = -way.y() / R;
  return (R * R - way.squaredNorm()) / (2.0 * R);
}

void PoseDescent::measure(PosePoint& point) const noexcept {
  const int first = planner_.options_.base_goal ? 1 : 0;
  if (first == 1) {
    JointVector unused;
    point.slack[0] = slack_gradient(point, 0, unused);
  }
  for (int i = 0; i < planner_.clearances_.size(); ++i) {
    point.slack[first + i] = planner_.clearances_.value(point.posture, point.q.data(), i);
  }
  point.violation = -point.slack.cwiseMin(0.0).sum();
}

double PoseDescent::rank(const JointVector& q) noexcept {
  there_->q = q;
  place_joints(planner_.chain_, q.data(), there_->posture);
  measure(*there_);
  geometric_jacobian(planner_.chain_, there_->posture, planner_.frame_,
                     ReferenceFrame::kWorldAligned, there_->J);
  const JointVector& weights = planner_.options_.column_weights;
  return log_dexterity_bound(there_->J, weights.size() > 0 ? weights.data() : nullptr) +
         kViolationPrice * there_->violation;
}

// Inverse kinematics from q, to within the tolerance.
bool PoseDescent::bring(const JointVector& q, int most, double tolerance,
                        PosePoint& point) noexcept {
  IkPoint hand{q, {}};
  int returns = 0;
  ik_.position_tolerance = ik_.rotation_tolerance = tolerance;
  const bool reached = thing_kin::descend(ik_, most, hand, returns, point.posture);
  ik_.position_tolerance = ik_.rotation_tolerance = on_target(ik_.residual.target());
  if (!reached) {
    if (hand.value.cost() < nearest_cost_) {
      nearest_cost_ = hand.value.cost();
      nearest_ = hand.q;
    }
    return false;
  }
  point.q = hand.q;
  point.miss << hand.value.e.head<3>() / ik_.residual.position_scale(), hand.value.log;
  measure(point);
  return true;
}

bool PoseDescent::derive(PosePoint& point) const noexcept {
  geometric_jacobian(planner_.chain_, point.posture, planner_.frame_, ReferenceFrame::kWorldAligned,
                     point.J);
  point.rows.factor(point.J);
  point.rows.null_space(point.Z);
  const JointVector& weights = planner_.options_.column_weights;
  return log_dexterity_along(planner_.chain_, point.J, point.Z,
                             weights.size() > 0 ? weights.data() : nullptr, point.objective);
}

// The value alone.
bool PoseDescent::evaluate(PosePoint& point) const noexcept {
  geometric_jacobian(planner_.chain_, point.posture, planner_.frame_, ReferenceFrame::kWorldAligned,
                     point.J);
  const JointVector& weights = planner_.options_.column_weights;
  point.objective.value = log_dexterity(point.J, weights.size() > 0 ? weights.data() : nullptr);
  return std::isfinite(point.objective.value);
}

bool PoseDescent::begin(const JointVector& q) noexcept {
  mu_.setZero();
  nu_ = JointVector::Zero(q.size());
  radius_ = kFirstRadius;
  penalty_ = kFirstPenalty;
  return bring(q, kMostArrivals, kLargestMiss, *here_) && derive(*here_);
}

// What the inequalities of the step before add to the Lagrangian: their pull, and their curvature
// along Z.
void PoseDescent::add_inequalities(JointVector& pull) noexcept {
  if (!(mu_.array() > 0.0).any()) {
    return;
  }
  const int first = planner_.options_.base_goal ? 1 : 0;
  SmallMatrix W = SmallMatrix::Zero(pull.size(), pull.size());
  JointVector along;
  for (int i = 0; i < static_cast<int>(mu_.size()); ++i) {
    if (!(mu_[i] > 0.0)) {
      continue;
    }
    slack_gradient(*here_, i, along);
    pull -= mu_[i] * along;
    if (i < first) {
      const auto& base = *planner_.chain_.base_joints();
      W(base[0], base[0]) += mu_[i] / planner_.options_.base_radius;
      W(base[1], base[1]) += mu_[i] / planner_.options_.base_radius;
    } else {
      planner_.clearances_.add_hessian(here_->posture, here_->q.data(), i - first, -mu_[i], W);
    }
  }
  // Small: coefficient by coefficient is quicker than by blocks.
  const SmallMatrix WZ = W.lazyProduct(here_->Z);
  H_ += here_->Z.transpose().lazyProduct(WZ);
}

// The way back to the target, which every step takes, and the Lagrangian's gradient and Hessian in
// the null space of J. The pose's multipliers are those of least squares, given those of the
// inequalities of the step before.
void PoseDescent::reduce() noexcept {
  const JointVector& gradient = here_->objective.gradient;
  g_.noalias() = here_->Z.transpose().lazyProduct(gradient);
  H_ = here_->objective.hessian;
  JointVector pull = gradient - nu_;
  add_inequalities(pull);
  here_->rows.apply_q_transposed(pull.data());
  lambda_ = pull.head<6>();
  here_->rows.solve_r(lambda_.data());
  add_pose_curvature_along(planner_.chain_, here_->J, -lambda_, here_->Z, H_);
  Vector6 back = here_->miss;
  here_->rows.solve_r_transposed(back.data());
  back_.resize(gradient.size());
  here_->rows.lift(back.data(), back_.data());
}

// What each joint may do within its sides and the trust region, and what inequalities may come into
// play. An endless joint has no sides: it goes on at the other end.
void PoseDescent::collect_forms() noexcept {
  const Eigen::Index n = here_->q.size();
  const Eigen::Index k = here_->Z.cols();
  forms_.topLeftCorner(k, n) = here_->Z.transpose();
  for (Eigen::Index j = 0; j < n; ++j) {
    const bool endless = ik_.box.is_endless(j);
    const double from = here_->q[j] + back_[j];
    lower_[j] = endless ? -radius_ : std::max(-radius_, ik_.box.lower(j) - from);
    upper_[j] = endless ? radius_ : std::min(radius_, ik_.box.upper(j) - from);
  }
  inequalities_.clear();
  const double way = radius_ * std::sqrt(static_cast<double>(n));
  for (int i = 0; i < static_cast<int>(mu_.size()); ++i) {
    const std::size_t place = inequalities_.size();
    JointVector& along = gradients_[place];
    const double slack = slack_gradient(*here_, i, along) + along.dot(back_);
    if (slack > way * along.norm()) {
      continue;
    }
    const Eigen::Index column = n + static_cast<Eigen::Index>(place);
    forms_.col(column).head(k).noalias() = here_->Z.transpose() * along;
    lower_[column] = -slack;
    upper_[column] = std::numeric_limits<double>::infinity();
    inequalities_.push_back(i);
  }
}

// Curvature across sides that were active in the last step costs nothing if they hold again, and
// may be all that is missing to convexity: |a . z - b|^2 vanishes on them.
bool PoseDescent::stiffen(const FormsView& forms) noexcept {
  const double stiffness = 10.0 * H_.cwiseAbs().maxCoeff();
  const auto n = static_cast<int>(here_->q.size());
  SmallMatrix H = H_;
  SmallVector g = g_;
  int count = 0;
  const auto add = [&](int form, double bound) {
    const auto a = forms.col(form);
    const double weight = stiffness / std::max(a.squaredNorm(), kLeastCurvature);
    H += weight * a * a.transpose();
    g -= weight * bound * a;
    stiffened_[static_cast<std::size_t>(count++)] = form;
  };
  for (int j = 0; j < n && count < kMaxDof; ++j) {
    if (nu_[j] != 0.0) {
      add(j, nu_[j] > 0.0 ? lower_[j] : upper_[j]);
    }
  }
  for (int i = 0; std::cmp_less(i, inequalities_.size()) && count < kMaxDof; ++i) {
    if (mu_[inequalities_[static_cast<std::size_t>(i)]] > 0.0) {
      add(n + i, lower_[n + i]);
    }
  }
  if (count == 0 ||
      qp_.minimize(H, g, forms, lower_.data(), upper_.data()) != ConvexQp::Status::kOptimal) {
    return false;
  }
  return std::all_of(stiffened_.begin(), std::next(stiffened_.begin(), count),
                     [&](int form) { return qp_.holds(form); });
}

// The Hessian with the size of each curvature instead of itself.
void PoseDescent::convexify() noexcept {
  if (H_.rows() == 3) {  // most robots: a size that the compiler knows is three times as fast
    H_ = with_sizes_of_curvature<Eigen::Matrix3d>(H_);
  } else {
    H_ = with_sizes_of_curvature<SmallMatrix>(H_);
  }
}

// The quadratic program, made convex if it is not.
bool PoseDescent::minimize() noexcept {
  const Eigen::Index k = here_->Z.cols();
  const Eigen::Index count = here_->q.size() + static_cast<Eigen::Index>(inequalities_.size());
  const auto forms = forms_.topLeftCorner(k, count);
  ConvexQp::Status status = qp_.minimize(H_, g_, forms, lower_.data(), upper_.data());
  exact_ = status != ConvexQp::Status::kNotConvex;
  if (!exact_ && stiffen(forms)) {
    exact_ = true;
    status = ConvexQp::Status::kOptimal;
  } else if (!exact_) {
    convexify();
    status = qp_.minimize(H_, g_, forms, lower_.data(), upper_.data());
  }
  if (status == ConvexQp::Status::kOptimal) {
    z_ = qp_.x();
    remember_multipliers();
    return true;
  }
  return status == ConvexQp::Status::kInfeasible && relax();
}

// Where no step keeps all inequalities: one more variable t >= 0 that they may all fall short by,
// at a price.
bool PoseDescent::relax() noexcept {
  const Eigen::Index n = here_->q.size();
  const Eigen::Index k = here_->Z.cols();
  const Eigen::Index count = n + static_cast<Eigen::Index>(inequalities_.size());
  if (k + 1 > kMaxDof || k + 1 > forms_.rows()) {
    return false;
  }
  SmallMatrix H = SmallMatrix::Zero(k + 1, k + 1);
  H.topLeftCorner(k, k) = H_;
  const double price = std::max(10.0 * penalty_, 100.0 * (1.0 + g_.cwiseAbs().maxCoeff()));
  H(k, k) = 1e-3 * price;
  SmallVector g(k + 1);
  g << g_, price;
  forms_.row(k).head(n).setZero();
  forms_.row(k).segment(n, count - n).setOnes();
  forms_.col(count).head(k).setZero();
  forms_(k, count) = 1.0;
  lower_[count] = 0.0;
  upper_[count] = std::numeric_limits<double>::infinity();
  const auto forms = forms_.topLeftCorner(k + 1, count + 1);
  if (qp_.minimize(H, g, forms, lower_.data(), upper_.data()) != ConvexQp::Status::kOptimal) {
    return false;
  }
  z_ = qp_.x().head(k);
  exact_ = false;
  remember_multipliers();
  return true;
}

void PoseDescent::remember_multipliers() noexcept {
  const auto n = static_cast<int>(here_->q.size());
  mu_.setZero();
  nu_.setZero();
  for (int i = 0; i < qp_.active(); ++i) {
    const ConvexQp::Active active = qp_[i];
    const auto beyond = static_cast<std::size_t>(active.form - n);
    if (active.form < n) {
      nu_[active.form] = active.multiplier;
    } else if (beyond < inequalities_.size()) {
      mu_[inequalities_[beyond]] = active.multiplier;
    }
  }
  // Powell (1978): a multiplier that was large for one step does not hold up all later ones.
  const double needed = 1.5 * mu_.sum();
  penalty_ = std::max({kFirstPenalty, needed, 0.5 * (penalty_ + needed)});
}

double PoseDescent::predicted_violation() const noexcept {
  double sum = 0.0;
  const Eigen::Index n = here_->q.size();
  for (std::size_t i = 0; i < inequalities_.size(); ++i) {
    const Eigen::Index column = n + static_cast<Eigen::Index>(i);
    const double along = forms_.col(column).head(z_.size()).dot(z_);
    sum += std::max(0.0, lower_[column] - along);
  }
  return sum;
}

bool PoseDescent::misses() const noexcept {
  const double most = on_target(ik_.residual.target());
  return here_->miss.head<3>().norm() > most || here_->miss.tail<3>().norm() > most;
}

// How far from the target a step of so much gain may end.
double PoseDescent::loose_tolerance(double gain) const noexcept {
  const double price = 1.0 + lambda_.cwiseAbs().maxCoeff() + penalty_;
  return std::clamp(kMissWorth * gain / price, on_target(ik_.residual.target()), kLargestMiss);
}

// A step after which nothing is left to gain: the hand goes to the target, and no derivatives are
// needed. kTaken: it is not the last after all.
PoseDescent::Step PoseDescent::finish(const JointVector& q, double length) noexcept {
  if (!bring(q, kMostReturns, on_target(ik_.residual.target()), *there_)) {
    radius_ = 0.25 * length;
    return Step::kRefused;
  }
  if (there_->violation <= planner_.options_.tolerance && evaluate(*there_)) {
    std::swap(here_, there_);
    return Step::kLast;
  }
  return Step::kTaken;
}

// The end of a descent that did not end by finish().
bool PoseDescent::settle() noexcept {
  if (misses()) {
    if (!bring(here_->q, kMostReturns, on_target(ik_.residual.target()), *there_) ||
        !evaluate(*there_)) {
      return false;
    }
    std::swap(here_, there_);
  }
  return is_feasible();
}

PoseDescent::Step PoseDescent::step(double best) noexcept {
  reduce();
  collect_forms();
  if (!minimize()) {
    return Step::kStuck;
  }
  const JointVector dq = here_->Z.lazyProduct(z_);  // beside back_
  const double length = dq.cwiseAbs().maxCoeff();
  const double gain =
      -(g_.dot(z_) + 0.5 * z_.dot(H_ * z_)) + penalty_ * (here_->violation - predicted_violation());
  const bool feasible = is_feasible();
  const bool done = length <= kNoStep || (feasible && gain <= kLeastGain);
  if (done && !(exact_ && misses())) {
    return Step::kLast;
  }
  if (exact_ && length < 0.9 * radius_ && here_->objective.value - kHope * gain > best) {
    return Step::kStuck;
  }
  JointVector q = here_->q + back_ + dq;
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    q[j] = ik_.box.inside(j, q[j]);
  }
  const bool last = length <= kLastStep || (feasible && gain <= kLastGain);
  if (exact_ && last && length < 0.9 * radius_) {
    const Step outcome = finish(q, length);
    if (outcome != Step::kTaken) {
      return outcome;
    }
  } else if (!bring(q, kMostReturns, loose_tolerance(gain), *there_)) {
    radius_ = 0.25 * length;
    return Step::kRefused;
  }
  if (!derive(*there_)) {
    radius_ = 0.25 * length;
    return Step::kRefused;
  }
  // What is missed to the target costs what its multipliers say.
  const double came = here_->objective.value - there_->objective.value +
                      lambda_.dot(here_->miss - there_->miss) +
                      penalty_ * (here_->violation - there_->violation);
  if (!(came >= kAccept * gain)) {
    radius_ = 0.3 * length;
    return Step::kRefused;
  }
  if (came > kEnlarge * gain && length > 0.7 * radius_) {
    radius_ = std::min(2.0 * radius_, kLargestRadius);
  }
  std::swap(here_, there_);
  return Step::kTaken;
}

bool PoseDescent::descend(int most, double best) noexcept {
  if (here_->q.size() == 6) {  // nothing is free
    return settle();
  }
  for (int i = 0; i < most; ++i) {
    ++iterations_;
    const Step outcome = step(best);
    if (outcome == Step::kLast) {
      return settle();
    }
    if (outcome == Step::kStuck || radius_ < kLeastRadius) {
      break;
    }
  }
  settle();
  return false;
}

}  // namespace thing_kin
