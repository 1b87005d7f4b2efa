#pragma once

// A step in the null space of the hand, as plan_pose takes it: nine joints, six equations, eighteen
// sides of a box.

#include "problem.hpp"

namespace bench {

struct QuadraticProgram {
  Eigen::Matrix<double, 9, 9> H;
  Vector9 g;
  Matrix69 A;
  Eigen::Matrix<double, 6, 1> b;
  static constexpr double kSide = 0.4;  ///< |x_i| at most

  explicit QuadraticProgram(const Problem::Input& input)
      : H(0.2 * input.jacobian.transpose() * input.jacobian +
          0.5 * Eigen::Matrix<double, 9, 9>::Identity()),
        g(input.qd),
        A(input.jacobian),
        b(input.jacobian * (0.3 * input.qd.cwiseMin(1.0).cwiseMax(-1.0))) {}
};

}  // namespace bench
