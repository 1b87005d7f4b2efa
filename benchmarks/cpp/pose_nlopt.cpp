// NLopt's SLSQP in C++ on instances of (4.34): a line of numbers each on standard input (see
// benchmarks/pose/solvers/nlopt_cpp.py), a line of joint values, claim and CPU seconds each out.
// Functions and derivatives are thing_kin's; the objective is log sqrt(kappa/M), as for all peers.

#include <array>
#include <ctime>
#include <iostream>
#include <limits>
#include <vector>

#include <nlopt.hpp>

#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/kinematics/log_dexterity.hpp"
#include "thing_kin/kinematics/posture.hpp"
#include "thing_kin/lie/so3.hpp"
#include "thing_kin/model/robots.hpp"

namespace {

using namespace thing_kin;
using Vector = std::vector<double>;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kJoints = 9;

struct Instance {
  Vector lower, upper;
  SE3 target;
  Eigen::Vector2d goal, obstacle;
  double radius, keep_out;
  Vector seed;
};

// The hand's Jacobian at the q asked for last: objective and pose are asked for at the same q.
class Functions {
 public:
  explicit Functions(const Chain& robot) : robot_(robot) {}

  void set(const Instance& instance) {
    instance_ = &instance;
    q_.assign(kJoints, std::numeric_limits<double>::quiet_NaN());
  }

  double objective(const Vector& q, Vector& gradient) {
    move(q);
    if (gradient.empty()) {
      return log_dexterity(J_, nullptr);
    }
    LogDexterity out;  // no second derivative: SLSQP asks for none
    if (log_dexterity_along(robot_, J_, none_, nullptr, out)) {
      Eigen::Map<Eigen::VectorXd>(gradient.data(), kJoints) = out.gradient;
    }
    return out.value;
  }

  void pose(double* result, const double* q, double* gradient) {
    move(Vector(q, q + kJoints));
    const SE3 hand = frame_pose(robot_, posture_, robot_.tool());
    const SE3& target = instance_->target;
    const Eigen::Vector3d turn = so3_log(target.rotation * hand.rotation.transpose());
    Eigen::Map<Vector6> error(result);
    error << target.translation - hand.translation, turn;
    if (gradient != nullptr) {
      Eigen::Map<RowMajor> J(gradient, 6, kJoints);
      J = -J_;
      J.bottomRows<3>() = -so3_right_jacobian_inverse(turn) * J_.bottomRows(3);
    }
  }

  // At most 0: outside the disc about the goal, inside the obstacle, squared.
  void room(double* result, const double* q, double* gradient) const {
    const Eigen::Map<const Eigen::Vector2d> base(q + 6);
    const Eigen::Vector2d to_goal = base - instance_->goal;
    const Eigen::Vector2d to_obstacle = base - instance_->obstacle;
    result[0] = to_goal.squaredNorm() - instance_->radius * instance_->radius;
    result[1] = instance_->keep_out * instance_->keep_out - to_obstacle.squaredNorm();
    if (gradient != nullptr) {
      Eigen::Map<RowMajor> J(gradient, 2, kJoints);
      J.setZero();
      J.block<1, 2>(0, 6) = 2.0 * to_goal.transpose();
      J.block<1, 2>(1, 6) = -2.0 * to_obstacle.transpose();
    }
  }

 private:
  void move(const Vector& q) {
    if (q != q_) {
      q_ = q;
      place_joints(robot_, q.data(), posture_);
      geometric_jacobian(robot_, posture_, robot_.tool(), ReferenceFrame::kWorldAligned, J_);
    }
  }

  const Chain& robot_;
  const Instance* instance_ = nullptr;
  Vector q_;
  Posture posture_;
  Jacobian J_;
  const SmallMatrix none_ = SmallMatrix(kJoints, 0);  // directions
};

double objective(const Vector& q, Vector& gradient, void* data) {
  return static_cast<Functions*>(data)->objective(q, gradient);
}

void pose(unsigned, double* result, unsigned, const double* q, double* gradient, void* data) {
  static_cast<Functions*>(data)->pose(result, q, gradient);
}

void room(unsigned, double* result, unsigned, const double* q, double* gradient, void* data) {
  static_cast<Functions*>(data)->room(result, q, gradient);
}

bool read(std::istream& in, Instance& instance) {
  std::array<double, 5 * kJoints> x;
  for (double& value : x) {
    if (!(in >> value)) {
      return false;
    }
  }
  instance.lower.assign(x.data(), x.data() + 9);
  instance.upper.assign(x.data() + 9, x.data() + 18);
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> T(x.data() + 18);
  instance.target.rotation = T.leftCols<3>();
  instance.target.translation = T.col(3);
  instance.goal << x[30], x[31];
  instance.radius = x[32];
  instance.obstacle << x[33], x[34];
  instance.keep_out = x[35];
  instance.seed.assign(x.data() + 36, x.data() + 45);
  return true;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// As a user would: a solver made for the instance, the tolerances of the other peers.
bool solve(const Instance& instance, Functions& functions, Vector& q) {
  nlopt::opt solver(nlopt::LD_SLSQP, kJoints);
  solver.set_lower_bounds(instance.lower);
  solver.set_upper_bounds(instance.upper);
  solver.set_min_objective(&objective, &functions);
  solver.add_equality_mconstraint(&pose, &functions, Vector(6, 1e-8));
  solver.add_inequality_mconstraint(&room, &functions, Vector(2, 1e-8));
  solver.set_xtol_rel(1e-9);
  solver.set_maxeval(500);
  q = instance.seed;
  double value = 0.0;
  try {
    return solver.optimize(q, value) > 0;
  } catch (const std::exception&) {  // rounding stops it where it stands
    return false;
  }
}

}  // namespace

int main() {
  const Chain robot = robots::thing();
  Functions functions(robot);
  Instance instance;
  std::cout.precision(17);
  for (bool warm = false; read(std::cin, instance); warm = true) {
    Vector q;
    functions.set(instance);
    if (!warm) {
      solve(instance, functions, q);
      functions.set(instance);
    }
    const double start = cpu_seconds();
    const bool claim = solve(instance, functions, q);
    const double took = cpu_seconds() - start;
    for (const double value : q) {
      std::cout << value << ' ';
    }
    std::cout << claim << ' ' << took << '\n';
  }
  return 0;
}
