#include "pose_descent.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

// How many inequalities: the base's disc, if there is one, and the clearances.
int PoseDescent::slacks(const PosePlanner& planner) noexcept {
  return planner.clearances_.size() + (planner.options_.base_goal ? 1 : 0);
}

PoseDescent::PoseDescent(const PosePlanner& planner, const SE3& target)
    : planner_(planner),
      ik_(make_ik(planner, planner.box_, planner.reach_, target)),
      program_(planner.chain_.dof(), slacks(planner)) {
  for (PosePoint* point : {here_, there_}) {
    point->slack.resize(slacks(planner));
  }
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
  program_.begin();
  radius_ = kFirstRadius;
  return bring(q, kMostArrivals, kLargestMiss, *here_) && derive(*here_);
}

// What the inequalities of the step before add to the Lagrangian: their pull, and their curvature
// along Z.
void PoseDescent::add_inequalities(JointVector& pull, SmallMatrix& H) noexcept {
  const Eigen::VectorXd& mu = program_.of_inequalities();
  if (!(mu.array() > 0.0).any()) {
    return;
  }
  const int first = planner_.options_.base_goal ? 1 : 0;
  SmallMatrix W = SmallMatrix::Zero(pull.size(), pull.size());
  JointVector along;
  for (int i = 0; i < static_cast<int>(mu.size()); ++i) {
    if (!(mu[i] > 0.0)) {
      continue;
    }
    slack_gradient(*here_, i, along);
    pull -= mu[i] * along;
    if (i < first) {
      const auto& base = *planner_.chain_.base_joints();
      W(base[0], base[0]) += mu[i] / planner_.options_.base_radius;
      W(base[1], base[1]) += mu[i] / planner_.options_.base_radius;
    } else {
      planner_.clearances_.add_hessian(here_->posture, here_->q.data(), i - first, -mu[i], W);
    }
  }
  // Small: coefficient by coefficient is quicker than by blocks.
  const SmallMatrix WZ = W.lazyProduct(here_->Z);
  H += here_->Z.transpose().lazyProduct(WZ);
}

// The way back to the target, which every step takes, and the Lagrangian's gradient and Hessian in
// the null space of J. The pose's multipliers are those of least squares, given those of the
// inequalities of the step before.
void PoseDescent::reduce() noexcept {
  const JointVector& gradient = here_->objective.gradient;
  SmallMatrix H = here_->objective.hessian;
  JointVector pull = gradient - program_.of_sides();
  add_inequalities(pull, H);
  here_->rows.apply_q_transposed(pull.data());
  lambda_ = pull.head<6>();
  here_->rows.solve_r(lambda_.data());
  add_pose_curvature_along(planner_.chain_, here_->J, -lambda_, here_->Z, H);
  program_.reset(here_->Z, H, here_->Z.transpose().lazyProduct(gradient));
  Vector6 back = here_->miss;
  here_->rows.solve_r_transposed(back.data());
  back_.resize(gradient.size());
  here_->rows.lift(back.data(), back_.data());
}

// What each joint may do within its sides and the trust region, and what inequalities may come into
// play. An endless joint has no sides: it goes on at the other end.
void PoseDescent::bound() noexcept {
  const Eigen::Index n = here_->q.size();
  for (Eigen::Index j = 0; j < n; ++j) {
    const bool endless = ik_.box.is_endless(j);
    const double from = here_->q[j] + back_[j];
    program_.bound(j, endless ? -radius_ : std::max(-radius_, ik_.box.lower(j) - from),
                   endless ? radius_ : std::min(radius_, ik_.box.upper(j) - from));
  }
  const double way = radius_ * std::sqrt(static_cast<double>(n));
  JointVector along;
  for (int i = 0; i < static_cast<int>(here_->slack.size()); ++i) {
    const double slack = slack_gradient(*here_, i, along) + along.dot(back_);
    if (slack <= way * along.norm()) {
      program_.add(i, slack, here_->Z, along);
    }
  }
}

bool PoseDescent::misses() const noexcept {
  const double most = on_target(ik_.residual.target());
  return here_->miss.head<3>().norm() > most || here_->miss.tail<3>().norm() > most;
}

// How far from the target a step of so much gain may end.
double PoseDescent::loose_tolerance(double gain) const noexcept {
  const double price = 1.0 + lambda_.cwiseAbs().maxCoeff() + program_.penalty();
  return std::clamp(kMissWorth * gain / price, on_target(ik_.residual.target()), kLargestMiss);
}

// A step after which nothing is left to gain: the hand goes to the target, and no derivatives are
// needed. Nothing: it is not the last after all.
std::optional<PoseDescent::Step> PoseDescent::finish(const JointVector& q, double length) noexcept {
  if (!bring(q, kMostReturns, on_target(ik_.residual.target()), *there_)) {
    radius_ = 0.25 * length;
    return Step::kRefused;
  }
  if (there_->violation <= planner_.options_.tolerance && evaluate(*there_)) {
    std::swap(here_, there_);
    return Step::kLast;
  }
  return std::nullopt;
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
  bound();
  if (!program_.minimize()) {
    return Step::kStuck;
  }
  const bool exact = program_.is_exact();
  const double penalty = program_.penalty();
  const JointVector dq = here_->Z.lazyProduct(program_.z());  // beside back_
  const double length = dq.cwiseAbs().maxCoeff();
  const double gain = program_.gain() + penalty * (here_->violation - program_.violation());
  const bool feasible = is_feasible();
  const bool done = length <= kNoStep || (feasible && gain <= kLeastGain);
  if (done && !(exact && misses())) {
    return Step::kLast;
  }
  if (exact && length < 0.9 * radius_ && here_->objective.value - kHope * gain > best) {
    return Step::kStuck;
  }
  JointVector q = here_->q + back_ + dq;
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    q[j] = ik_.box.inside(j, q[j]);
  }
  const bool last = length <= kLastStep || (feasible && gain <= kLastGain);
  if (exact && last && length < 0.9 * radius_) {
    if (const std::optional<Step> outcome = finish(q, length)) {
      return *outcome;
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
                      penalty * (here_->violation - there_->violation);
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
