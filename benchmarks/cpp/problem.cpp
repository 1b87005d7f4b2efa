#include "problem.hpp"

#include <random>

#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/kinematics/posture.hpp"
#include "thing_kin/model/robots.hpp"

namespace bench {

namespace {

template <int n>
Eigen::Matrix<double, n, 1> uniform(std::mt19937_64& generator, double bound) {
  std::uniform_real_distribution<double> draw(-bound, bound);
  return Eigen::Matrix<double, n, 1>::NullaryExpr([&] { return draw(generator); });
}

Problem::Input draw(const thing_kin::Chain& robot, std::mt19937_64& generator) {
  Problem::Input input;
  input.q = uniform<9>(generator, 3.0);
  input.qd = uniform<9>(generator, 1.0);
  thing_kin::Posture posture;
  thing_kin::place_joints(robot, input.q.data(), posture);
  thing_kin::Jacobian J;
  thing_kin::geometric_jacobian(robot, posture, robot.tool(),
                                thing_kin::ReferenceFrame::kWorldAligned, J);
  input.jacobian = J;
  const Vector9 near = input.q + uniform<9>(generator, 0.02);
  input.T_goal = thing_kin::forward_kinematics(robot, near.data(), robot.tool());
  input.base_goal = input.q.head<3>() + uniform<3>(generator, 0.02);
  input.twist = uniform<6>(generator, 0.1);
  return input;
}

}  // namespace

Problem::Problem() : robot(thing_kin::robots::thing(thing_kin::JointOrder::kBaseFirst)) {
  std::mt19937_64 generator(0);
  for (std::size_t i = 0; i < kInputs; ++i) {
    inputs.push_back(draw(robot, generator));
  }
  for (std::size_t i = 0; i < kRows; ++i) {
    const Vector9 q = uniform<9>(generator, 3.0);
    rows.insert(rows.end(), q.begin(), q.end());
  }
}

const Problem& problem() {
  static const Problem instance;
  return instance;
}

std::vector<Entry>& entries() {
  static std::vector<Entry> instance;
  return instance;
}

std::vector<Level> levels() {
  std::vector<Level> found;
  for (const Level level : {Level::kAvx512, Level::kAvx2, Level::kBaseline}) {
    if (level <= best()) {
      found.push_back(level);
    }
  }
  return found;
}

std::string name_of(Level level) {
  const std::string name = "thing_kin";
  return level == best() ? name : name + "_" + thing_kin::to_string(level);
}

}  // namespace bench
