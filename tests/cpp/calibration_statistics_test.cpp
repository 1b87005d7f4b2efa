// Losses against Ceres' own, leverages against the hat matrix as textbooks write it.

#include <array>
#include <cmath>

#include <ceres/loss_function.h>
#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/estimation/calibration_leverage.hpp"
#include "thing_kin/estimation/calibration_loss.hpp"

namespace thing_kin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void expect_same(CalibrationLoss loss, const ceres::LossFunction& theirs, double scale) {
  for (const double square : {0.0, 1e-8, 0.3, 0.99, 1.7, 6.0, 250.0}) {
    const auto ours = loss_at(loss, scale, square);
    std::array<double, 3> expected{};
    theirs.Evaluate(square, expected.data());
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(ours[i], expected[i], 1e-14 * (1.0 + std::abs(expected[i]))) << square;
    }
  }
}

TEST(CalibrationLoss, IsThatOfCeres) {
  constexpr double kScale = 1.3;
  expect_same(CalibrationLoss::kLinear, ceres::TrivialLoss(), kScale);
  expect_same(CalibrationLoss::kHuber, ceres::HuberLoss(kScale), kScale);
  expect_same(CalibrationLoss::kSoftL1, ceres::SoftLOneLoss(kScale), kScale);
  expect_same(CalibrationLoss::kCauchy, ceres::CauchyLoss(kScale), kScale);
  expect_same(CalibrationLoss::kTukey, ceres::TukeyLoss(kScale), kScale);
}

class Leverage : public testing::Test {
 protected:
  void SetUp() override {
    test::Generator rng(5);
    J = RowMajorMatrix::NullaryExpr(30, 7, [&] { return test::uniform(rng, -1, 1); });
    r = VectorXd::NullaryExpr(30, [&] { return test::uniform(rng, -2, 2); });
    parameters.resize(7);
    for (std::size_t i = 0; i < 7; ++i) {
      parameters[i].deviation = std::pow(10.0, static_cast<double>(i) - 3.0);
    }
  }

  MatrixXd hat() const {
    MatrixXd N = J.transpose() * J;
    for (Index i = 0; i < 7; ++i) {
      N(i, i) += std::pow(parameters[static_cast<std::size_t>(i)].deviation, -2.0);
    }
    return J * N.inverse() * J.transpose();
  }

  RowMajorMatrix J;
  VectorXd r;
  std::vector<CalibrationParameter> parameters;
};

TEST_F(Leverage, IsTheHatMatrix) {
  const CalibrationLeverage leverage(J, parameters);
  const MatrixXd H = hat();
  EXPECT_LT((leverage.shares() - H.diagonal()).norm(), 1e-12);
  for (Index row = 0; row < 30; row += 6) {
    const MatrixXd own = MatrixXd::Identity(6, 6) - H.block(row, row, 6, 6);
    const VectorXd rest = r.segment(row, 6);
    const double expected = rest.dot(own.inverse() * rest);
    EXPECT_NEAR(leverage.square_of_rest(row, rest), expected, 1e-10 * expected);
  }
}

// A number that one parameter takes whole has no residual of its own.
TEST_F(Leverage, WhatIsTakenWholeTellsNothing) {
  J.col(6).setZero();
  J.row(2).setZero();
  J(2, 6) = 1e6;
  const CalibrationLeverage leverage(J, parameters);
  EXPECT_NEAR(leverage.shares()[2], 1.0, 1e-12);
  VectorXd rest = r.head(6);
  const double square = leverage.square_of_rest(0, rest);
  rest[2] = 1e9;
  EXPECT_NEAR(leverage.square_of_rest(0, rest), square, 1e-6 * square);
}

TEST_F(Leverage, ColumnsThatAreTheSameCountOnce) {
  J.col(1) = J.col(0);
  for (auto& parameter : parameters) {
    parameter.deviation = 1e8;  // nothing is known before
  }
  EXPECT_NEAR(CalibrationLeverage(J, parameters).shares().sum(), 6.0, 1e-6);
}

}  // namespace
}  // namespace thing_kin
