#include <cmath>
#include <cstdio>

#include "thing_kin/core/version.hpp"
#include "thing_kin/inverse/task_priority.hpp"
#include "thing_kin/model/robots.hpp"

#ifdef CONSUMER_CERES
#include "thing_kin/optimization/ceres_minimizer.hpp"

// The least step of a model whose gradient points along x: to the edge of its box.
bool minimizes() {
  thing_kin::ConvexModel model;
  model.gradient = Eigen::Vector2d(1.0, 0.0);
  model.hessian = Eigen::Matrix2d::Identity();
  model.jacobian.resize(0, 2);
  model.box_lower = Eigen::Vector2d(-0.5, -0.5);
  model.box_upper = -model.box_lower;
  const auto minimizer =
      thing_kin::make_ceres_minimizer(thing_kin::CeresMethod::kAugmentedLagrangian);
  return (minimizer->minimize(model).p - Eigen::Vector2d(-0.5, 0.0)).norm() < 1e-9;
}
#else
bool minimizes() { return true; }
#endif

int main() {
  const thing_kin::Chain robot = thing_kin::robots::thing();
  const Eigen::VectorXd q = Eigen::VectorXd::Zero(robot.dof());
  const thing_kin::SE3 T = thing_kin::forward_kinematics(robot, q.data(), robot.tool());
  std::printf("thing_kin %s: tool at x = %.6f m\n", thing_kin::kVersion, T.translation.x());
  return std::abs(T.translation.x() - 0.526141) < 1e-12 && minimizes() ? 0 : 1;
}
