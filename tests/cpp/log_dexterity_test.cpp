#include "thing_kin/kinematics/log_dexterity.hpp"

#include <random>

#include <gtest/gtest.h>

#include "every_level.hpp"
#include "random_chain.hpp"
#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/kinematics/manipulability.hpp"
#include "thing_kin/kinematics/pose_curvature.hpp"
#include "thing_kin/kinematics/pose_error.hpp"
#include "thing_kin/model/robots.hpp"

namespace thing_kin {
namespace {

class LogDexterityTest : public test::EveryLevel {};

INSTANTIATE_TEST_SUITE_P(LogDexterity, LogDexterityTest, test::every_level(),
                         [](const auto& level) { return to_string(level.param); });

JointVector random_q(const Chain& chain, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> angle(-2.5, 2.5);
  JointVector q(chain.dof());
  for (double& x : q) {
    x = angle(rng);
  }
  return q;
}

Jacobian jacobian_at(const Chain& chain, const JointVector& q) {
  Posture posture;
  place_joints(chain, q.data(), posture);
  Jacobian J;
  geometric_jacobian(chain, posture, chain.tool(), ReferenceFrame::kWorldAligned, J);
  return J;
}

// Differences of the gradient, fourth order.
SmallMatrix numeric_hessian(const Chain& chain, const JointVector& q, const double* weights,
                            const DexterityWeights& share) {
  const Eigen::Index n = q.size();
  SmallMatrix H = SmallMatrix::Zero(n, n);
  constexpr double h = 1e-4;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double factor[4] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12};
    const double step[4] = {-2, -1, 1, 2};
    for (int s = 0; s < 4; ++s) {
      JointVector moved = q;
      moved[k] += step[s] * h;
      LogDexterity at;
      EXPECT_TRUE(log_dexterity(chain, jacobian_at(chain, moved), weights, at, share));
      H.col(k) += factor[s] / h * at.gradient;
    }
  }
  return H;
}

void expect_derivatives(const Chain& chain, const double* weights, const DexterityWeights& share,
                        std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    const JointVector q = random_q(chain, rng);
    LogDexterity at;
    const Jacobian J = jacobian_at(chain, q);
    if (!log_dexterity(chain, J, weights, at, share) || at.log_condition_number > 5.0) {
      continue;
    }
    ++checked;
    const SmallMatrix H = numeric_hessian(chain, q, weights, share);
    const double scale = 1.0 + at.hessian.norm();
    EXPECT_LE((at.hessian - H).norm(), 2e-5 * scale) << chain.name() << "\n"
                                                     << at.hessian << "\n\n"
                                                     << H;
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      constexpr double h = 1e-5;
      JointVector up = q;
      JointVector down = q;
      up[k] += h;
      down[k] -= h;
      LogDexterity above;
      LogDexterity below;
      log_dexterity(chain, jacobian_at(chain, up), weights, above, share);
      log_dexterity(chain, jacobian_at(chain, down), weights, below, share);
      EXPECT_NEAR(at.gradient[k], (above.value - below.value) / (2 * h), 1e-5 * scale);
    }
  }
  EXPECT_GT(checked, 20);
}

TEST_P(LogDexterityTest, DerivativesOfTheThing) {
  expect_derivatives(robots::thing(), nullptr, {}, 1);
}

TEST_P(LogDexterityTest, DerivativesOfEachMeasure) {
  expect_derivatives(robots::thing(), nullptr, {1.0, 0.0}, 2);
  expect_derivatives(robots::thing(), nullptr, {0.0, 1.0}, 3);
}

TEST_P(LogDexterityTest, DerivativesOfTheArmAlone) {
  const Chain robot = robots::thing();
  const double arm[9] = {1, 1, 1, 1, 1, 1, 0, 0, 0};
  expect_derivatives(robot, arm, {}, 4);
}

TEST_P(LogDexterityTest, DerivativesWithUnequalWeights) {
  const Chain robot = robots::thing();
  const double weights[9] = {1, 0.5, 2, 0.7, 1, 1, 0.3, 0.9, 0.2};
  expect_derivatives(robot, weights, {}, 5);
}

TEST_P(LogDexterityTest, DerivativesOfRandomChains) {
  test::Generator rng(6);
  int redundant = 0;
  for (int i = 0; i < 40; ++i) {
    const Chain chain = test::random_chain(rng);
    if (chain.dof() >= 6) {
      ++redundant;
      expect_derivatives(chain, nullptr, {}, 100 + static_cast<std::uint64_t>(i));
    }
  }
  EXPECT_GT(redundant, 5);
}

// In some directions, as the whole one says.
void expect_the_same_along(const Chain& chain, const double* weights, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const DexterityWeights share{0.3, 0.8};
  for (int i = 0; i < 30; ++i) {
    const Jacobian J = jacobian_at(chain, random_q(chain, rng));
    SmallMatrix Z(chain.dof(), 1 + i % chain.dof());
    for (Eigen::Index k = 0; k < Z.size(); ++k) {
      Z.data()[k] = any(rng);
    }
    LogDexterity whole;
    LogDexterity along;
    ASSERT_EQ(log_dexterity(chain, J, weights, whole, share),
              log_dexterity_along(chain, J, Z, weights, along, share));
    const SmallMatrix expected = Z.transpose() * whole.hessian * Z;
    const double size = 1.0 + whole.hessian.cwiseAbs().maxCoeff() * (chain.dof() * chain.dof());
    EXPECT_LE((along.hessian - expected).cwiseAbs().maxCoeff(), 1e-12 * size);
    EXPECT_EQ(along.gradient, whole.gradient);
    EXPECT_EQ(along.value, whole.value);
  }
}

TEST_P(LogDexterityTest, AlongDirectionsItIsTheWholeOne) {
  const double weights[9] = {1, 0.5, 2, 0.7, 1, 1, 0.3, 0.9, 0.2};
  expect_the_same_along(robots::thing(), nullptr, 11);
  expect_the_same_along(robots::thing(), weights, 12);
  test::Generator rng(13);
  for (int i = 0; i < 40; ++i) {
    const Chain chain = test::random_chain(rng);
    if (chain.dof() >= 6) {
      expect_the_same_along(chain, nullptr, 200 + static_cast<std::uint64_t>(i));
    }
  }
}

TEST_P(LogDexterityTest, ValueIsThatOfTheSingularValues) {
  const Chain robot = robots::thing();
  std::mt19937_64 rng(7);
  for (int i = 0; i < 100; ++i) {
    const JointVector q = random_q(robot, rng);
    Posture posture;
    place_joints(robot, q.data(), posture);
    const Dexterity dexterity(robot, posture, robot.tool());
    LogDexterity at;
    const Jacobian J = jacobian_at(robot, q);
    ASSERT_TRUE(log_dexterity(robot, J, nullptr, at));
    EXPECT_NEAR(at.value, std::log(dexterity.dexterity()), 1e-9);
    EXPECT_NEAR(at.log_condition_number, std::log(dexterity.condition_number()), 1e-9);
    EXPECT_NEAR(at.log_manipulability, std::log(dexterity.manipulability()), 1e-9);
    EXPECT_NEAR(log_dexterity(J, nullptr), at.value, 1e-9);
  }
}

TEST_P(LogDexterityTest, BoundIsALittleAbove) {
  const Chain robot = robots::thing();
  std::mt19937_64 rng(9);
  const double weights[9] = {1, 0.5, 2, 0.7, 1, 1, 0.3, 0.9, 0.2};
  double most = 0.0;
  double sum = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Jacobian J = jacobian_at(robot, random_q(robot, rng));
    const double* const columns = i % 2 == 0 ? nullptr : weights;
    const double above = log_dexterity_bound(J, columns) - log_dexterity(J, columns);
    EXPECT_GE(above, -1e-9);
    most = std::max(most, above);
    sum += above;
  }
  EXPECT_LT(most, std::log(6.0) / 16.0);
  EXPECT_LT(sum / 500, 0.03);
  // All eigenvalues equal: the bound is as far off as it can be.
  const Jacobian unit = Jacobian::Identity(6, 6);
  EXPECT_NEAR(log_dexterity_bound(unit, nullptr), std::log(6.0) / 16.0, 1e-12);
}

TEST_P(LogDexterityTest, LostRankIsInfinite) {
  const Chain arm = robots::ur10();
  const JointVector q = JointVector::Zero(6);
  LogDexterity at;
  EXPECT_FALSE(log_dexterity(arm, jacobian_at(arm, q), nullptr, at));
  EXPECT_TRUE(std::isinf(at.value));
  EXPECT_TRUE(std::isinf(log_dexterity(jacobian_at(arm, q), nullptr)));
  EXPECT_TRUE(std::isinf(log_dexterity_bound(jacobian_at(arm, q), nullptr)));
}

TEST(PoseCurvature, IsTheSecondDerivativeOfThePoseError) {
  const Chain robot = robots::thing();
  std::mt19937_64 rng(8);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    const JointVector q = random_q(robot, rng);
    const SE3 here = forward_kinematics(robot, q.data(), robot.tool());
    Vector6 weights;
    JointVector d(q.size());
    for (double& x : weights) {
      x = any(rng);
    }
    for (double& x : d) {
      x = any(rng);
    }
    SmallMatrix H = SmallMatrix::Zero(q.size(), q.size());
    add_pose_curvature(robot, jacobian_at(robot, q), weights, H);
    constexpr double h = 1e-3;
    const auto along = [&](double t) {
      const JointVector moved = q + t * d;
      const SE3 T = forward_kinematics(robot, moved.data(), robot.tool());
      return weights.dot(pose_error(here, T));
    };
    const double numeric =
        (-along(2 * h) + 16 * along(h) + 16 * along(-h) - along(-2 * h)) / (12 * h * h);
    EXPECT_NEAR(d.dot(H * d), numeric, 1e-6);
  }
}

TEST(PoseCurvature, AlongDirectionsItIsTheWholeOne) {
  test::Generator rng(14);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 40; ++i) {
    const Chain chain = test::random_chain(rng);
    const int n = chain.dof();
    Vector6 weights;
    JointVector q(n);
    SmallMatrix Z(n, 1 + i % n);
    for (double& x : weights) {
      x = any(rng);
    }
    for (double& x : q) {
      x = any(rng);
    }
    for (Eigen::Index k = 0; k < Z.size(); ++k) {
      Z.data()[k] = any(rng);
    }
    const Jacobian J = jacobian_at(chain, q);
    SmallMatrix H = SmallMatrix::Zero(n, n);
    add_pose_curvature(chain, J, weights, H);
    SmallMatrix along = SmallMatrix::Ones(Z.cols(), Z.cols());
    add_pose_curvature_along(chain, J, weights, Z, along);
    const SmallMatrix expected = Z.transpose() * H * Z + SmallMatrix::Ones(Z.cols(), Z.cols());
    EXPECT_LE((along - expected).cwiseAbs().maxCoeff(), 1e-11 * (1.0 + J.squaredNorm() * n));
  }
}

}  // namespace
}  // namespace thing_kin
