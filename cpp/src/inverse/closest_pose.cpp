#include "closest_pose.hpp"

#include <Eigen/Cholesky>

#include "thing_kin/kinematics/hessian.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin {

namespace {

using Joints = std::bitset<kMaxDof>;

// The gradient of the cost is rounding below this fraction of what a residual of its size can give.
constexpr double kStationary = 1e-10;

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

// The damped Newton step of the joints that are not held; false if the Hessian is not definite.
bool newton_step(Quadratic cost, const Joints& held, double damping, JointVector& step) noexcept {
  for (Eigen::Index j = 0; j < cost.gradient.size(); ++j) {
    if (held[static_cast<std::size_t>(j)]) {
      cost.gradient[j] = 0.0;
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
  expand(problem, point, cost);
  Joints held = pressed(problem.box, point.q, cost);
  for (int i = 0; i < most && !is_stationary(cost, held); ++i) {
    ++iterations;
    JointVector step;
    if (newton_step(cost, held, damping, step) && advance(problem, step, point)) {
      damping *= 0.1;
      expand(problem, point, cost);
      held = pressed(problem.box, point.q, cost);
    } else if (damping > kMostDamping) {
      return {true, held};  // no step of any length comes nearer in rounding
    } else {
      damping = std::max(8.0 * damping, kFirstDamping);
    }
  }
  return {is_stationary(cost, held), held};
}

}  // namespace thing_kin
