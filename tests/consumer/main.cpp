#include <cmath>
#include <cstdio>

#include "thing_kin/core/version.hpp"
#include "thing_kin/inverse/task_priority.hpp"
#include "thing_kin/model/robots.hpp"

int main() {
  const thing_kin::Chain robot = thing_kin::robots::thing();
  const Eigen::VectorXd q = Eigen::VectorXd::Zero(robot.dof());
  const thing_kin::SE3 T = thing_kin::forward_kinematics(robot, q.data(), robot.tool());
  std::printf("thing_kin %s: tool at x = %.6f m\n", thing_kin::kVersion, T.translation.x());
  return std::abs(T.translation.x() - 0.526141) < 1e-12 ? 0 : 1;
}
