#include "closest_pose.hpp"

#include <algorithm>

#include <Eigen/Cholesky>

#include "thing_kin/kinematics/hessian.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin {

namespace {

using Joints = std::bitset<kMaxDof>;

// The gradient of the cost is rounding below this fraction of what a residual of its size can give.
constexpr double kStationary = 1e-10;

// Where the solutions form a valley, the way along its floor is long and gains nothing: so many
// steps on end that gain less than this fraction of the cost are the end.
constexpr double kIdleGain = 1e-9;
constexpr int kMostIdle = 4;

// Newton's steps are damped between nothing and so much that a step is lost in rounding.
constexpr double kFirstDamping = 1e-4;
constexpr double kMostDamping = 1e12;

struct Quadratic {
  JointVector gradient;
  SmallMatrix hessian;
  double scale = 0.0;  // of the gradient's entries
};

// cost = |e|^2/2 and its derivatives: the gradient is -J^T e with the weighed J; the second
// derivative is J^T J and the part from the curvature of the pose itself, which does not vanish
// with the step where e does not.
void expand(const IkProblem& problem, const IkPoint& point, Quadratic& cost) noexcept {
  const PoseResidual& residual = problem.residual;
  Posture posture;
  place_joints(problem.chain, point.q.data(), posture);
  Jacobian J;
  geometric_jacobian(problem.chain, posture, problem.frame, ReferenceFrame::kWorldAligned, J);
  Hessian dJ;
  geometric_hessian(problem.chain, posture, problem.frame, ReferenceFrame::kWorldAligned, dJ);
  const RowFactors M = residual.derivative(point.value);
  Jacobian weighed(6, J.cols());
  for (Eigen::Index j = 0; j < J.cols(); ++j) {
    weighed.col(j) = M * J.col(j);
  }
  const Vector6 force = M.transposed() * point.value.e;
  cost.gradient = -(weighed.transpose() * point.value.e);
  cost.hessian.noalias() = weighed.transpose() * weighed;
  cost.scale = 0.0;
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    const JointVector bend = dJ[static_cast<std::size_t>(k)].transpose() * force;
    cost.hessian.col(k) -= 0.5 * bend;
    cost.hessian.row(k) -= 0.5 * bend.transpose();
    cost.scale = std::max(cost.scale, weighed.col(k).norm() * point.value.e.norm());
  }
}

// Joints at a side of the box that the gradient presses against it.
Joints pressed(const JointBox& box, const JointVector& q, const Quadratic& cost) noexcept {
  Joints joints;
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    const double push = -cost.gradient[j];
    const bool out = (q[j] >= box.upper(j) && push > 0.0) || (q[j] <= box.lower(j) && push < 0.0);
    joints.set(static_cast<std::size_t>(j), out && !box.is_endless(j));
  }
  return joints;
}

bool is_stationary(const Quadratic& cost, const Joints& held) noexcept {
  for (Eigen::Index j = 0; j < cost.gradient.size(); ++j) {
    if (!held[static_cast<std::size_t>(j)] &&
        std::abs(cost.gradient[j]) > kStationary * cost.scale) {
      return false;
    }
  }
  return true;
}

// The damped Newton step of the joints that are not fixed, where those that are move as `step`
// says; false if the Hessian is not definite.
bool solve_free(Quadratic cost, const Joints& fixed, double damping, JointVector& step) noexcept {
  cost.gradient.noalias() += cost.hessian * step;
  for (Eigen::Index j = 0; j < cost.gradient.size(); ++j) {
    if (fixed[static_cast<std::size_t>(j)]) {
      cost.gradient[j] = -step[j];
      cost.hessian.row(j).setZero();
      cost.hessian.col(j).setZero();
      cost.hessian(j, j) = 1.0;
    } else {
      cost.hessian(j, j) += damping;
    }
  }
  const Eigen::LLT<SmallMatrix> factors(cost.hessian);
  step = -factors.solve(cost.gradient);
  return factors.info() == Eigen::Success;
}

// The same within the box: joints that would leave it go to its side, and the others take that into
// account.
bool newton_step(const JointBox& box, const JointVector& q, const Quadratic& cost, Joints fixed,
                 double damping, JointVector& step) noexcept {
  JointVector known = JointVector::Zero(q.size());  // the steps of the fixed joints
  for (Eigen::Index round = 0; round <= q.size(); ++round) {
    step = known;
    if (!solve_free(cost, fixed, damping, step)) {
      return false;
    }
    bool again = false;
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      const auto bit = static_cast<std::size_t>(j);
      const double to = std::clamp(q[j] + step[j], box.lower(j), box.upper(j));
      if (!fixed[bit] && !box.is_endless(j) && to != q[j] + step[j]) {
        fixed.set(bit);
        known[j] = to - q[j];
        again = true;
      }
    }
    if (!again) {
      break;
    }
  }
  return true;
}

// Tries one step; true if it came nearer.
bool advance(const IkProblem& problem, const JointVector& step, IkPoint& point) noexcept {
  IkPoint next = point;
  const double largest = std::max(1.0, step.cwiseAbs().maxCoeff());
  for (Eigen::Index j = 0; j < step.size(); ++j) {
    next.q[j] = problem.box.inside(j, point.q[j] + step[j] / largest);
  }
  problem.residual.evaluate(forward_kinematics(problem.chain, next.q.data(), problem.frame),
                            next.value);
  if (!(next.value.cost() < point.value.cost())) {
    return false;
  }
  point = next;
  return true;
}

}  // namespace

Rest find_closest_pose(const IkProblem& problem, int most, IkPoint& point,
                       int& iterations) noexcept {
  Quadratic cost;
  double damping = kFirstDamping;
  int idle = 0;
  expand(problem, point, cost);
  Joints held = pressed(problem.box, point.q, cost);
  for (int i = 0; i < most && !is_stationary(cost, held); ++i) {
    ++iterations;
    JointVector step;
    const double before = point.value.cost();
    if (newton_step(problem.box, point.q, cost, held, damping, step) &&
        advance(problem, step, point)) {
      damping *= 0.1;
      idle = before - point.value.cost() < kIdleGain * before ? idle + 1 : 0;
      expand(problem, point, cost);
      held = pressed(problem.box, point.q, cost);
    } else {
      damping = std::max(8.0 * damping, kFirstDamping);
    }
    if (idle == kMostIdle || damping > kMostDamping) {  // no step of any length comes nearer
      return {true, held};
    }
  }
  return {is_stationary(cost, held), held};
}

}  // namespace thing_kin
