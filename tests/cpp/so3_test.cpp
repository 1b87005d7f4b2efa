#include "thing_kin/lie/so3.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/lie/series.hpp"

namespace thing_kin {
namespace {

constexpr double kPi = std::numbers::pi;

// sin, cos in extended precision: an oracle for the series, on both sides of the switch.
long double phi_oracle(int m, long double t) {
  long double sum = 0.0L;
  long double term = 1.0L;
  for (int i = 2; i <= m; ++i) {
    term /= i;
  }
  for (int k = 0; k < 40; ++k) {
    sum += term;
    term *= -t / ((2 * k + m + 1) * (2 * k + m + 2));
  }
  return sum;
}

TEST(Series, AgreesWithExtendedPrecision) {
  for (const double t : {0.0, 1e-20, 1e-8, 0.1, 0.999999, 1.0, 1.000001, 4.0, kPi * kPi}) {
    EXPECT_NEAR(phi<1>(t), static_cast<double>(phi_oracle(1, t)), 4e-16) << t;
    EXPECT_NEAR(phi<2>(t), static_cast<double>(phi_oracle(2, t)), 4e-16) << t;
    EXPECT_NEAR(phi<3>(t), static_cast<double>(phi_oracle(3, t)), 4e-16) << t;
    EXPECT_NEAR(phi<4>(t), static_cast<double>(phi_oracle(4, t)), 4e-16) << t;
    EXPECT_NEAR(phi<5>(t), static_cast<double>(phi_oracle(5, t)), 4e-16) << t;
    EXPECT_NEAR(phi<6>(t), static_cast<double>(phi_oracle(6, t)), 4e-16) << t;
  }
}

TEST(So3, LogUndoesExpAtEveryAngle) {
  test::Generator rng(1);
  for (const double angle : {0.0, 1e-300, 1e-12, 1e-8, 1e-4, 1.0, 3.0, kPi - 1e-6, kPi - 1e-9}) {
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d axis = test::random_vector(rng, 3).normalized();
      const Eigen::Vector3d phi_vector = angle * axis;
      EXPECT_LT((so3_log(so3_exp(phi_vector)) - phi_vector).norm(), 1e-15 + 2e-15 * angle) << angle;
    }
  }
}

TEST(So3, HalfTurnHasTheFirstComponentPositive) {
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, -1),
        Eigen::Vector3d(-0.6, 0.8, 0), Eigen::Vector3d(0, -0.6, 0.8)}) {
    const Eigen::Matrix3d R = 2 * axis * axis.transpose() - Eigen::Matrix3d::Identity();
    const Eigen::Vector3d phi_vector = so3_log(R);
    EXPECT_NEAR(phi_vector.norm(), kPi, 1e-15);
    const bool flip =
        axis[0] < 0 || (axis[0] == 0 && (axis[1] < 0 || (axis[1] == 0 && axis[2] < 0)));
    EXPECT_LT((phi_vector - (flip ? -kPi : kPi) * axis).norm(), 1e-14);
  }
}

TEST(So3, InverseJacobiansInvert) {
  test::Generator rng(2);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p = test::random_vector(rng, 3, 1.7);
    const Eigen::Matrix3d left = so3_left_jacobian(p) * so3_left_jacobian_inverse(p);
    const Eigen::Matrix3d right = so3_right_jacobian(p) * so3_right_jacobian_inverse(p);
    EXPECT_LT((left - Eigen::Matrix3d::Identity()).norm(), 1e-13);
    EXPECT_LT((right - Eigen::Matrix3d::Identity()).norm(), 1e-13);
  }
}

TEST(So3, DerivativeOfTheInverseRightJacobian) {
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double angle : {0.0, 1e-9, 1e-3, 0.99, 1.01, 2.0, 3.14, 5.0}) {
    const auto random = [&] { return Eigen::Vector3d(uniform(rng), uniform(rng), uniform(rng)); };
    const Eigen::Vector3d phi = angle * random().normalized();
    const Eigen::Vector3d weights = random();
    const Eigen::Matrix3d N = so3_right_jacobian_inverse_derivative(phi, weights);
    constexpr double h = 1e-3;
    for (int k = 0; k < 3; ++k) {
      const auto at = [&](double step) -> Eigen::RowVector3d {
        return weights.transpose() *
               so3_right_jacobian_inverse(phi + step * Eigen::Vector3d::Unit(k));
      };
      const Eigen::RowVector3d slope =
          (8.0 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12.0 * h);
      EXPECT_LT((slope - N.row(k)).norm(), 1e-10 * (1.0 + N.norm())) << angle;
    }
  }
}

}  // namespace
}  // namespace thing_kin
