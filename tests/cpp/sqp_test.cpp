// Algorithm 2 as C++ sees it: functions as terms, what they throw, options, determinism.

#include "thing_kin/optimization/sqp.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>

#include "thing_kin/core/error.hpp"
#include "thing_kin/model/robots.hpp"
#include "thing_kin/optimization/derivative_check.hpp"
#include "thing_kin/optimization/elastic_qp.hpp"
#include "thing_kin/optimization/function_term.hpp"

namespace thing_kin {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::shared_ptr<const Term> size_of_x() {
  return std::make_shared<FunctionTerm>(
      "size", 1, 0,
      [](const VectorView& x, Eigen::Ref<VectorXd> value, MatrixXd* J) {
        value[0] = x.squaredNorm();
        if (J != nullptr) {
          *J = 2.0 * x.transpose();
        }
        return true;
      },
      [](const VectorView& x, const VectorView& weights, MatrixXd& H) {
        H += 2.0 * weights[0] * MatrixXd::Identity(x.size(), x.size());
      });
}

// A sum of the variables that throws below a limit.
std::shared_ptr<const Term> sum_of_x(double throws_below = -INFINITY) {
  return std::make_shared<FunctionTerm>(
      "sum", 1, 0, [=](const VectorView& x, Eigen::Ref<VectorXd> value, MatrixXd* J) {
        if (x.sum() < throws_below) {
          throw std::domain_error("too small");
        }
        value[0] = x.sum();
        if (J != nullptr) {
          *J = MatrixXd::Ones(1, x.size());
        }
        return true;
      });
}

Problem on_the_circle() {
  Problem problem(VectorXd::Constant(2, -INFINITY), VectorXd::Constant(2, INFINITY));
  problem.minimize(sum_of_x());
  problem.constrain(size_of_x(), VectorXd::Constant(1, 2.0), VectorXd::Constant(1, 2.0));
  return problem;
}

TEST(Sqp, SolvesAProblemOfFunctions) {
  const VectorXd x0 = Eigen::Vector2d(0.3, -2.0);
  const SqpResult result = sqp(on_the_circle(), x0, ElasticQp());
  ASSERT_TRUE(result.success()) << result.message;
  EXPECT_LT((result.x - VectorXd::Constant(2, -1.0)).norm(), 1e-7);
  EXPECT_NEAR(result.multipliers[0], 0.5, 1e-7);
  EXPECT_EQ(sqp(on_the_circle(), x0, ElasticQp()).x, result.x);
}

TEST(Sqp, LetsExceptionsThrough) {
  Problem problem(VectorXd::Constant(2, -INFINITY), VectorXd::Constant(2, INFINITY));
  problem.minimize(sum_of_x(-1.0));
  EXPECT_THROW(sqp(problem, VectorXd::Zero(2), ElasticQp()), std::domain_error);
}

TEST(Sqp, RefusesWhatDoesNotFit) {
  const Problem problem = on_the_circle();
  EXPECT_THROW(sqp(problem, VectorXd::Zero(3), ElasticQp()), InvalidArgument);
  EXPECT_THROW(sqp(problem, VectorXd::Constant(2, NAN), ElasticQp()), InvalidArgument);
  SqpOptions options;
  options.tau_minus = 1.0;
  EXPECT_THROW(sqp(problem, VectorXd::Zero(2), ElasticQp(), options), InvalidArgument);
}

TEST(Sqp, SaysWhatDoesNotExist) {
  Problem problem(VectorXd::Constant(1, -INFINITY), VectorXd::Constant(1, INFINITY));
  problem.minimize(std::make_shared<FunctionTerm>(
      "nowhere", 1, 1, [](const VectorView&, Eigen::Ref<VectorXd> value, MatrixXd*) {
        value[0] = NAN;  // as bad as false
        return true;
      }));
  const SqpResult result = sqp(problem, VectorXd::Zero(1), ElasticQp());
  EXPECT_EQ(result.status, SolveStatus::kBudget);
  EXPECT_EQ(result.message, "'nowhere' does not exist at x0");
}

TEST(Problem, KeepsItsRobot) {
  Problem problem(std::make_shared<const Chain>(robots::thing()));
  EXPECT_EQ(problem.variables(), 9);
  EXPECT_EQ(problem.names()[static_cast<std::size_t>(problem.variable("theta"))], "theta");
  EXPECT_THROW(problem.variable("phi"), InvalidArgument);
}

TEST(FunctionTerm, DifferencesStandForAHessian) {
  const VectorXd x = Eigen::Vector3d(0.3, -2.0, 1.0);
  const DerivativeCheck check = check_derivatives(*size_of_x(), x);
  EXPECT_LT(check.jacobian.largest, 1e-10);
  EXPECT_LT(check.hessian.largest, 1e-9);
  MatrixXd H;
  ASSERT_TRUE(hessian_by_differences(*size_of_x(), x, VectorXd::Ones(1), H));
  EXPECT_LT((H - 2.0 * MatrixXd::Identity(3, 3)).norm(), 1e-9);
}

}  // namespace
}  // namespace thing_kin
