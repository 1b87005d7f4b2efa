// The minimizers of convex models against each other and against what defines a minimum.

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "thing_kin/linalg/signed_least_squares.hpp"
#include "thing_kin/optimization/ceres_minimizer.hpp"
#include "thing_kin/optimization/convexify.hpp"
#include "thing_kin/optimization/elastic_qp.hpp"

namespace thing_kin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double number(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }
  VectorXd vector(Index n) { return matrix(n, 1); }
  MatrixXd matrix(Index rows, Index cols) {
    return MatrixXd::NullaryExpr(rows, cols, [&] { return number(-1.0, 1.0); });
  }

 private:
  std::mt19937 engine_;
};

// Equalities, one-sided and two-sided rows, dependent ones, a singular Hessian, tight boxes.
ConvexModel random_model(unsigned seed) {
  Random random(seed);
  const auto n = static_cast<Index>(1 + seed % 7);
  const auto m = static_cast<Index>(seed % 5);
  ConvexModel model;
  model.gradient = random.vector(n);
  const MatrixXd root = random.matrix(n, seed % 3 == 0 ? std::max<Index>(1, n / 2) : n);
  model.hessian = root * root.transpose();
  model.penalty = std::pow(10.0, random.number(-1.0, 2.0));
  model.value = random.vector(m);
  model.jacobian = random.matrix(m, n);
  if (m > 1 && seed % 4 == 0) {
    model.jacobian.row(1) = 2.0 * model.jacobian.row(0);
  }
  model.lower = VectorXd::Constant(m, -INFINITY);
  model.upper = 0.3 * random.vector(m);
  for (Index i = 0; i < m; ++i) {
    if (i % 3 == 1) {
      model.lower[i] = model.upper[i];
    } else if (i % 3 == 2) {
      model.lower[i] = model.upper[i] - 0.1;
      model.upper[i] = seed % 2 == 0 ? INFINITY : model.upper[i];
    }
  }
  const double radius = std::pow(10.0, random.number(-2.0, 1.0));
  model.box_lower = VectorXd::Constant(n, -radius);
  model.box_upper = VectorXd::Constant(n, radius);
  if (seed % 6 == 1) {
    model.box_lower[0] = 0.0;
  }
  if (seed % 11 == 1) {
    model.box_upper[n - 1] = model.box_lower[n - 1] = 0.0;
  }
  return model;
}

struct Case {
  const char* name;
  double accuracy;  // of the model's value, relative to 1
  std::unique_ptr<ConvexMinimizer> minimizer;
};

std::vector<Case> ceres_cases() {
  std::vector<Case> cases;
  cases.push_back(
      {"augmented_lagrangian", 1e-7, make_ceres_minimizer(CeresMethod::kAugmentedLagrangian)});
  cases.push_back({"smoothed", 1e-6, make_ceres_minimizer(CeresMethod::kSmoothed)});
  cases.push_back({"bfgs", 1e-4, make_ceres_minimizer(CeresMethod::kBfgs)});
  return cases;
}

constexpr unsigned kModels = 200;

// A convex function's minimum: no point of a box around it is lower, nor any way along its
// subgradient, which the multipliers name.
TEST(ElasticQp, MeetsTheConditionsOfAMinimum) {
  for (unsigned seed = 0; seed < kModels; ++seed) {
    const ConvexModel model = random_model(seed);
    const ConvexStep step = ElasticQp().minimize(model);
    const VectorXd slope =
        model.gradient + model.hessian * step.p + model.jacobian.transpose() * step.multipliers;
    const double small = 1e-6 * std::max(1.0, model.penalty);
    for (Index j = 0; j < step.p.size(); ++j) {
      EXPECT_GE(step.p[j], model.box_lower[j]);
      EXPECT_LE(step.p[j], model.box_upper[j]);
      const bool is_above = step.p[j] > model.box_lower[j] + 1e-7;
      const bool is_below = step.p[j] < model.box_upper[j] - 1e-7;
      EXPECT_FALSE(is_above && slope[j] > small) << seed << " " << slope[j];
      EXPECT_FALSE(is_below && slope[j] < -small) << seed << " " << slope[j];
    }
    const VectorXd v = model.value + model.jacobian * step.p;
    for (Index i = 0; i < v.size(); ++i) {
      const double y = step.multipliers[i];
      EXPECT_LE(std::abs(y), model.penalty * (1.0 + 1e-9));
      if (v[i] > model.upper[i] + 1e-6) {
        EXPECT_NEAR(y, model.penalty, small) << seed;
      } else if (v[i] < model.lower[i] - 1e-6) {
        EXPECT_NEAR(y, -model.penalty, small) << seed;
      } else if (v[i] > model.lower[i] + 1e-6 && v[i] < model.upper[i] - 1e-6) {
        EXPECT_NEAR(y, 0.0, small) << seed;
      }
    }
  }
}

TEST(CeresMinimizer, AgreesWithTheQuadraticProgram) {
  const std::vector<Case> cases = ceres_cases();
  for (unsigned seed = 0; seed < kModels; ++seed) {
    const ConvexModel model = random_model(seed);
    const double best = model_value(model, ElasticQp().minimize(model).p);
    for (const Case& one : cases) {
      const ConvexStep step = one.minimizer->minimize(model);
      EXPECT_TRUE((step.p.array() >= model.box_lower.array()).all());
      EXPECT_TRUE((step.p.array() <= model.box_upper.array()).all());
      EXPECT_NEAR(model_value(model, step.p), best, one.accuracy * std::max(1.0, model.penalty))
          << one.name << " " << seed;
    }
  }
}

TEST(CeresMinimizer, SaysTheSameEachTime) {
  const ConvexModel model = random_model(17);
  for (const Case& one : ceres_cases()) {
    EXPECT_EQ(one.minimizer->minimize(model).p, one.minimizer->minimize(model).p) << one.name;
  }
}

TEST(Convexify, TheStepThatMeetsTheConstraintsStays) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const Index n = 5;
    const MatrixXd C = random.matrix(2, n);
    const VectorXd c = random.vector(2);
    const VectorXd g = random.vector(n);
    // Convex on C's null space, anything across.
    const MatrixXd Q = Eigen::HouseholderQR<MatrixXd>(C.transpose()).householderQ();
    MatrixXd H = random.matrix(n, n);
    H = Q.transpose() * (H + H.transpose()).eval() * Q;
    H.bottomRightCorner(3, 3) += 10.0 * MatrixXd::Identity(3, 3);
    H.topLeftCorner(2, 2) -= 10.0 * MatrixXd::Identity(2, 2);
    H = Q * H * Q.transpose();
    const auto convex = convex_across(H, C, c);
    ASSERT_TRUE(convex.has_value());
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<MatrixXd>(convex->hessian).eigenvalues()[0], -1e-9);
    const auto solve = [&](const MatrixXd& B, const VectorXd& slope) {
      MatrixXd K = MatrixXd::Zero(n + 2, n + 2);
      K.topLeftCorner(n, n) = B;
      K.topRightCorner(n, 2) = C.transpose();
      K.bottomLeftCorner(2, n) = C;
      VectorXd rhs(n + 2);
      rhs << -slope, -c;
      return VectorXd(K.fullPivLu().solve(rhs));
    };
    const VectorXd step = solve(H, g);
    EXPECT_LT((solve(convex->hessian, g + convex->slope) - step).norm(), 1e-7 * step.norm());
  }
}

TEST(SignedLeastSquares, MeetsItsConditions) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const auto rows = static_cast<Index>(1 + seed % 6);
    const auto cols = static_cast<Index>(1 + seed % 9);
    MatrixXd A = random.matrix(rows, cols);
    if (cols > 2 && seed % 2 == 0) {
      A.col(2) = A.col(0);
    }
    const VectorXd b = random.vector(rows);
    std::vector<bool> free;
    for (Index j = 0; j < cols; ++j) {
      free.push_back(j % 4 == 3);
    }
    const VectorXd x = signed_least_squares(A, b, free);
    const VectorXd slope = A.transpose() * (b - A * x);
    for (Index j = 0; j < cols; ++j) {
      const bool is_free = free[static_cast<std::size_t>(j)];
      EXPECT_TRUE(is_free || x[j] >= 0.0);
      EXPECT_LT(slope[j], 1e-9) << seed;
      EXPECT_TRUE(slope[j] > -1e-9 || (!is_free && x[j] == 0.0)) << seed << " " << slope[j];
    }
  }
}

}  // namespace
}  // namespace thing_kin
