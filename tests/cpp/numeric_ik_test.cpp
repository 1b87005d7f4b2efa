#include "thing_kin/inverse/numeric_ik.hpp"

#include <thread>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/core/simd.hpp"
#include "thing_kin/lie/so3.hpp"
#include "thing_kin/model/robots.hpp"

namespace thing_kin {
namespace {

SE3 random_pose(test::Generator& rng, double angle) {
  Eigen::Vector3d axis = test::random_vector(rng, 3);
  axis *= angle / axis.norm();
  return {so3_exp(axis), test::random_vector(rng, 3)};
}

PoseWeights random_weights(test::Generator& rng, bool isotropic, WeightAxes axes) {
  PoseWeights weights;
  weights.axes = axes;
  for (std::size_t i = 0; i < 6; ++i) {
    weights.weight[i] = isotropic ? weights.weight[i] : test::uniform(rng, 0.1, 3.0);
  }
  weights.weight[4] = isotropic ? 1.0 : 0.0;
  return weights;
}

TEST(LowDiscrepancy, IsTheAdditiveSequence) {
  // n = 1: the golden ratio; n = 2: the plastic number.
  const LowDiscrepancy one(1, 0);
  const LowDiscrepancy two(2, 0);
  const double golden = 0.618033988749894848;
  const double plastic = 1.3247179572447460259609088;
  const auto part = [](double x) { return x - std::floor(x); };
  for (std::uint64_t k = 1; k < 50; ++k) {
    const auto x = static_cast<double>(k);
    EXPECT_NEAR(part(one(k, 0) - one(0, 0)), part(x * golden), 1e-13);
    EXPECT_NEAR(part(two(k, 0) - two(0, 0)), part(x / plastic), 1e-13);
    EXPECT_NEAR(part(two(k, 1) - two(0, 1)), part(x / (plastic * plastic)), 1e-13);
  }
}

TEST(LowDiscrepancy, FillsEveryTenthOfEveryCoordinate) {
  for (const std::uint64_t seed : {0ULL, 1ULL, ~0ULL}) {
    const LowDiscrepancy sequence(9, seed);
    for (int j = 0; j < 9; ++j) {
      std::array<int, 10> count{};
      for (std::uint64_t k = 0; k < 1000; ++k) {
        const double x = sequence(k, j);
        ASSERT_GE(x, 0.0);
        ASSERT_LT(x, 1.0);
        ++count[static_cast<std::size_t>(10 * x)];
      }
      for (const int tenth : count) {
        EXPECT_NEAR(tenth, 100, 15);  // a random sequence strays by 30
      }
    }
  }
}

TEST(DampedInverse, IsTheFormula) {
  test::Generator rng(1);
  const SimdLevel best = simd_level();
  for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (level > best) {
      continue;
    }
    use_simd_level(level);
    for (int n = 1; n <= kMaxDof; ++n) {
      Jacobian J = Eigen::MatrixXd::NullaryExpr(6, n, [&] { return test::uniform(rng, -1, 1); });
      JointVector mobility = JointVector::NullaryExpr(n, [&] { return test::uniform(rng, 0, 2); });
      mobility[0] = n % 3 == 0 ? 0.0 : mobility[0];
      RowFactors M;
      const Eigen::Matrix3d linear = Eigen::Matrix3d::Random();
      const Eigen::Matrix3d angular = Eigen::Matrix3d::Random();
      M.set(linear, angular);
      Eigen::MatrixXd A(6, n);
      A << linear * J.topRows<3>(), angular * J.bottomRows<3>();
      const Vector6 e = test::random_vector(rng, 6);
      const double lambda = 0.01;
      JointVector dq(n);
      damped_inverse(J, M, mobility.data(), lambda, e, dq.data());
      const Eigen::MatrixXd W = Eigen::VectorXd(mobility).asDiagonal();
      const Matrix6 normal = A * W * A.transpose() + lambda * Matrix6::Identity();
      const Eigen::VectorXd expected = W * A.transpose() * normal.fullPivLu().solve(e);
      EXPECT_LT((dq - expected).norm(), 1e-11 * (1.0 + expected.norm())) << n;
    }
  }
  use_simd_level(best);
}

TEST(PoseResidual, ItsDerivativeIsExact) {
  test::Generator rng(2);
  for (const double angle : {0.0, 1e-9, 1e-4, 0.0199, 0.0201, 0.5, 2.0, 3.1}) {
    for (const bool isotropic : {true, false}) {
      for (const WeightAxes axes : {WeightAxes::kTarget, WeightAxes::kWorld}) {
        const SE3 target = random_pose(rng, 1.0);
        SE3 T = random_pose(rng, angle);
        T.rotation = T.rotation * target.rotation;
        const PoseResidual residual(target, random_weights(rng, isotropic, axes), 0.4);
        PoseResidual::Value value;
        residual.evaluate(T, value);
        const RowFactors M = residual.derivative(value);
        for (Eigen::Index k = 0; k < 6; ++k) {
          const Vector6 twist = Vector6::Unit(k);
          const double h = 1e-6;
          Vector6 change = Vector6::Zero();
          for (const double side : {1.0, -1.0}) {
            const SE3 moved{so3_exp(side * h * twist.tail<3>()) * T.rotation,
                            T.translation + side * h * twist.head<3>()};
            PoseResidual::Value other;
            residual.evaluate(moved, other);
            change -= side * other.e;
          }
          const Vector6 numeric = change / (2 * h);
          EXPECT_LT((M * twist - numeric).norm(), 2e-8) << angle << " " << k;
        }
      }
    }
  }
}

TEST(PoseResidual, ARotationOfFewDigitsIsMadeOne) {
  SE3 target;
  target.rotation = so3_exp({0.3, -0.2, 0.5});
  const SE3 exact = target;
  target.rotation(0, 1) += 3e-7;
  const PoseResidual residual(target, {}, 1.0);
  PoseResidual::Value value;
  residual.evaluate(residual.target(), value);
  EXPECT_LT(value.rotation_error, 1e-15);
  residual.evaluate(exact, value);
  EXPECT_LT(value.rotation_error, 1e-6);
}

TEST(JointBox, GoesOnAtTheOtherEnd) {
  const JointBox box(robots::ur10());  // +-2 pi
  const double pi = std::numbers::pi;
  EXPECT_TRUE(box.is_endless(0));
  EXPECT_NEAR(box.inside(0, 2 * pi + 0.1), 0.1, 1e-12);
  EXPECT_NEAR(box.inside(0, -2 * pi - 0.1), -0.1, 1e-12);
  EXPECT_NEAR(box.inside(0, 40 * pi + 0.1), 0.1, 1e-12);
  JointVector q = JointVector::Zero(6);
  box.wind_towards(JointVector::Constant(6, 5.0), q);
  EXPECT_EQ(q, JointVector::Constant(6, 2 * pi));
  q.setZero();
  box.wind_towards(JointVector::Constant(6, 3.0), q);  // less than half a turn away
  EXPECT_EQ(q, JointVector::Zero(6));
  box.wind_towards(JointVector::Constant(6, -4.0), q);
  EXPECT_EQ(q, JointVector::Constant(6, -2 * pi));
}

TEST(JointBox, LessThanATurnHasTwoEnds) {
  DhRow row;
  row.joint = JointType::kRevolute;
  row.limits.lower = -std::numbers::pi;
  row.limits.upper = std::numbers::pi - 1e-6;
  const Chain chain = Chain::from_dh(std::vector<DhRow>{row});
  const JointBox box(chain);
  EXPECT_FALSE(box.is_endless(0));
  EXPECT_EQ(box.inside(0, 3.5), chain.upper()[0]);
}

TEST(JointBox, KeepsNearExactly) {
  test::Generator rng(3);
  for (int i = 0; i < 1000; ++i) {
    JointBox box(robots::thing());
    const JointVector seed = test::random_vector(rng, 9);
    const JointVector step = test::random_vector(rng, 9).cwiseAbs();
    box.keep_near(seed, step);
    for (Eigen::Index j = 0; j < 9; ++j) {
      EXPECT_LE(box.upper(j) - seed[j], step[j]);
      EXPECT_LE(seed[j] - box.lower(j), step[j]);
    }
  }
}

TEST(Reach, BoundsTheDistance) {
  test::Generator rng(4);
  for (int i = 0; i < 300; ++i) {
    const Chain chain = test::random_chain(rng);
    const int frame = chain.tool();
    JointBox box(chain);
    const JointVector seed = test::random_vector(rng, chain.dof());
    box.keep_near(seed, JointVector::Constant(chain.dof(), 0.5));
    const JointVector q = seed + test::random_vector(rng, chain.dof(), 0.5);
    const SE3 T = forward_kinematics(chain, q.data(), frame);
    EXPECT_EQ(Reach(chain, frame).beyond(box, T.translation), 0.0);
  }
  const Chain robot = robots::thing();
  const Reach reach(robot, robot.tool());
  EXPECT_GT(reach.beyond(JointBox(robot), {0, 0, 50}), 45.0);
}

TEST(JointBox, WindsWhereATurnIsLostInRounding) {
  for (const double limit : {1e15, 1e16, 3e17, 1e20, 1e300, 1.7e308}) {
    DhRow row;
    row.joint = JointType::kRevolute;
    row.limits.lower = -limit;
    row.limits.upper = limit;
    const Chain chain = Chain::from_dh(std::vector<DhRow>{row});
    const JointBox box(chain);
    for (int i = -100; i <= 100; ++i) {
      const JointVector seed = JointVector::Constant(1, i < 0 ? -limit : limit);
      JointVector q = JointVector::Constant(1, 0.03 * i);
      box.wind_towards(seed, q);  // ends
      EXPECT_TRUE(box.contains(q)) << limit;
    }
  }
}

TEST(IkResult, SaysWhatIsAmiss) {
  const Chain arm = robots::ur10();
  IkResult result;
  result.q = JointVector::Zero(6);
  result.status = IkStatus::kUnreachable;
  result.rotation_error = 5e-10;
  EXPECT_EQ(message(arm, result), "5e-10 rad beyond reach");
  result.position_error = 2e-10;
  EXPECT_EQ(message(arm, result), "5e-10 rad beyond reach");
  result.position_error = 0.5;
  EXPECT_EQ(message(arm, result), "0.5 m beyond reach");
  result.rotation_error = 0.25;
  EXPECT_EQ(message(arm, result), "0.5 m and 0.25 rad beyond reach");
}

TEST(NumericIk, KeepsQFiniteWhereSquaresOverflow) {
  const double inf = std::numeric_limits<double>::infinity();
  for (Chain robot : {robots::thing(), robots::ur10()}) {
    std::vector<JointLimits> limits = robot.limits();
    for (const bool limited : {true, false}) {
      for (JointLimits& limit : limits) {
        limit.lower = limited ? limit.lower : -inf;
        limit.upper = limited ? limit.upper : inf;
      }
      robot = robot.with_limits(limits);
      for (const double size : {1e50, 1e155, 1e200, 1e300}) {
        const SE3 target{Eigen::Matrix3d::Identity(), {size, -size, size}};
        const JointVector seed = JointVector::Constant(robot.dof(), size);
        for (const double* from : {seed.data(), static_cast<const double*>(nullptr)}) {
          for (const int restarts : {0, 3}) {
            IkOptions options;
            options.max_restarts = restarts;
            const IkResult result = NumericIk(robot, robot.tool(), options).solve(target, from);
            ASSERT_EQ(result.q.size(), robot.dof());
            EXPECT_TRUE(result.q.allFinite()) << size;
            EXPECT_TRUE(JointBox(robot).contains(result.q));
          }
        }
      }
    }
  }
}

TEST(NumericIk, ThreadsShareOne) {
  const Chain arm = robots::ur10();
  const NumericIk solver(arm, arm.tool());
  test::Generator rng(5);
  std::vector<SE3> targets;
  for (int i = 0; i < 50; ++i) {
    const Eigen::VectorXd q = test::random_vector(rng, 6);
    targets.push_back(forward_kinematics(arm, q.data(), arm.tool()));
  }
  const auto solve_all = [&] {
    std::vector<IkResult> results;
    for (const SE3& target : targets) {
      results.push_back(solver.solve(target, nullptr));
    }
    return results;
  };
  const auto expected = solve_all();
  std::array<std::vector<IkResult>, 4> found;
  {
    std::vector<std::jthread> threads;
    for (auto& results : found) {
      threads.emplace_back([&] { results = solve_all(); });
    }
  }
  for (const auto& results : found) {
    for (std::size_t i = 0; i < targets.size(); ++i) {
      EXPECT_TRUE(expected[i].success());
      EXPECT_EQ(results[i].q, expected[i].q);
    }
  }
}

TEST(NumericIk, AnswersWhateverTheTarget) {
  test::Generator rng(6);
  for (int i = 0; i < 300; ++i) {
    const Chain chain = test::random_chain(rng);
    IkOptions options;
    options.max_restarts = 3;
    const NumericIk solver(chain, chain.tool(), options);
    const SE3 target{random_pose(rng, 2.0).rotation,
                     std::pow(10.0, i % 12) * Eigen::Vector3d::Ones()};
    const Eigen::VectorXd seed = test::random_vector(rng, chain.dof());
    for (const double* from : {seed.data(), static_cast<const double*>(nullptr)}) {
      const IkResult result = solver.solve(target, from);
      EXPECT_TRUE(result.q.allFinite());
      EXPECT_TRUE(std::isfinite(result.position_error));
      EXPECT_TRUE(JointBox(chain).contains(result.q));
      EXPECT_FALSE(message(chain, result).empty());
    }
  }
}

}  // namespace
}  // namespace thing_kin
