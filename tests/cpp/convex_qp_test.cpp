#include "thing_kin/linalg/convex_qp.hpp"

#include <limits>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "random_chain.hpp"

namespace thing_kin {
namespace {

using test::Generator;
using test::uniform;

struct Case {
  SmallMatrix H;
  SmallVector g;
  Eigen::MatrixXd forms;
  Eigen::VectorXd lower, upper;
};

Case random_case(Generator& rng, int k, int m) {
  Case c;
  const SmallMatrix A = SmallMatrix::NullaryExpr(k, k, [&] { return uniform(rng, -1, 1); });
  c.H = A * A.transpose() + uniform(rng, 1e-3, 1.0) * SmallMatrix::Identity(k, k);
  c.g = SmallVector::NullaryExpr(k, [&] { return uniform(rng, -3, 3); });
  c.forms = Eigen::MatrixXd::NullaryExpr(k, m, [&] { return uniform(rng, -1, 1); });
  const SmallVector inside = SmallVector::NullaryExpr(k, [&] { return uniform(rng, -1, 1); });
  const Eigen::VectorXd value = c.forms.transpose() * inside;
  c.lower = value;
  c.upper = value;
  for (int i = 0; i < m; ++i) {
    const bool open = uniform(rng, 0, 1) < 0.3;
    c.lower[i] -= open ? std::numeric_limits<double>::infinity() : uniform(rng, 0, 0.5);
    c.upper[i] +=
        uniform(rng, 0, 1) < 0.3 ? std::numeric_limits<double>::infinity() : uniform(rng, 0, 0.5);
  }
  return c;
}

// The conditions of Karush, Kuhn and Tucker: with a convex objective they are the proof.
void expect_optimal(const Case& c, const ConvexQp& qp, double tolerance) {
  SmallVector residual = c.H * qp.x() + c.g;
  const Eigen::VectorXd value = c.forms.transpose() * qp.x();
  for (int i = 0; i < c.forms.cols(); ++i) {
    EXPECT_GE(value[i], c.lower[i] - tolerance);
    EXPECT_LE(value[i], c.upper[i] + tolerance);
  }
  double scale = 1.0;
  for (int i = 0; i < qp.active(); ++i) {
    const ConvexQp::Active active = qp[i];
    residual -= active.multiplier * c.forms.col(active.form);
    scale = std::max(scale, std::abs(active.multiplier));
    const double low = c.lower[active.form];
    const double high = c.upper[active.form];
    if (low < high) {
      EXPECT_NEAR(value[active.form], active.multiplier >= 0.0 ? low : high, tolerance);
    }
  }
  EXPECT_LE(residual.cwiseAbs().maxCoeff(), tolerance * scale);
}

TEST(ConvexQp, RandomProblemsSatisfyTheOptimalityConditions) {
  Generator rng(1);
  ConvexQp qp;
  for (int i = 0; i < 20000; ++i) {
    const int k = std::uniform_int_distribution<int>(1, 9)(rng);
    const Case c = random_case(rng, k, std::uniform_int_distribution<int>(0, 40)(rng));
    ASSERT_EQ(qp.minimize(c.H, c.g, c.forms, c.lower.data(), c.upper.data()),
              ConvexQp::Status::kOptimal)
        << i;
    expect_optimal(c, qp, 1e-8);
  }
}

TEST(ConvexQp, EqualitiesHold) {
  Generator rng(2);
  ConvexQp qp;
  for (int i = 0; i < 2000; ++i) {
    Case c = random_case(rng, 9, 24);
    const SmallVector inside = SmallVector::NullaryExpr(9, [&] { return uniform(rng, -1, 1); });
    const Eigen::VectorXd value = c.forms.transpose() * inside;
    for (int j = 0; j < 24; ++j) {
      c.lower[j] = j < 6 ? value[j] : std::min(c.lower[j], value[j]);
      c.upper[j] = j < 6 ? value[j] : std::max(c.upper[j], value[j]);
    }
    ASSERT_EQ(qp.minimize(c.H, c.g, c.forms, c.lower.data(), c.upper.data()),
              ConvexQp::Status::kOptimal);
    expect_optimal(c, qp, 1e-8);
    for (int j = 0; j < 6; ++j) {
      EXPECT_NEAR(c.forms.col(j).dot(qp.x()), value[j], 1e-10);
    }
  }
}

TEST(ConvexQp, DependentAndRepeatedForms) {
  Generator rng(3);
  ConvexQp qp;
  for (int i = 0; i < 2000; ++i) {
    Case c = random_case(rng, 3, 12);
    for (int j = 4; j < 12; ++j) {  // the same forms again, some scaled, with their own bounds
      c.forms.col(j) = c.forms.col(j % 4);
      c.lower[j] = c.lower[j % 4];
      c.upper[j] = c.upper[j % 4];
    }
    ASSERT_EQ(qp.minimize(c.H, c.g, c.forms, c.lower.data(), c.upper.data()),
              ConvexQp::Status::kOptimal);
    expect_optimal(c, qp, 1e-8);
  }
}

TEST(ConvexQp, SaysWhatIsInfeasible) {
  ConvexQp qp;
  const SmallMatrix H = SmallMatrix::Identity(2, 2);
  const SmallVector g = SmallVector::Zero(2);
  Eigen::MatrixXd forms(2, 3);
  forms << 1, 0, 1, 0, 1, 1;
  const double lower[] = {1, 1, -5};
  const double upper[] = {2, 2, 1.9};  // x + y <= 1.9
  EXPECT_EQ(qp.minimize(H, g, forms, lower, upper), ConvexQp::Status::kInfeasible);
  const double touching[] = {2, 2, 2.0};
  EXPECT_EQ(qp.minimize(H, g, forms, lower, touching), ConvexQp::Status::kOptimal);
  EXPECT_NEAR(qp.x()[0], 1.0, 1e-12);
}

TEST(ConvexQp, SaysWhatIsNotConvex) {
  ConvexQp qp;
  SmallMatrix H = SmallMatrix::Identity(3, 3);
  H(1, 1) = -1.0;
  const SmallVector g = SmallVector::Ones(3);
  EXPECT_EQ(qp.minimize(H, g, Eigen::MatrixXd(3, 0), nullptr, nullptr),
            ConvexQp::Status::kNotConvex);
}

}  // namespace
}  // namespace thing_kin
