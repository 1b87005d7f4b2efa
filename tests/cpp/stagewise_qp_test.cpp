#include "thing_kin/linalg/stagewise_qp.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "random_chain.hpp"

namespace thing_kin {
namespace {

// The same program as dense matrices, filled by hand.
struct Dense {
  Eigen::MatrixXd H, A;
  Eigen::VectorXd g, c, rho;
};

// Random blocks; the rows' constants are of both signs, so that some hold back and some can't hold.
Dense random_program(test::Generator& rng, StagewiseQp& qp, int stages, int rows) {
  const int m = qp.size();
  const int n = m * stages;
  const auto any = [&] { return test::uniform(rng, -1.0, 1.0); };
  Dense dense;
  dense.H = Eigen::MatrixXd::Zero(n, n);
  dense.g = Eigen::VectorXd::NullaryExpr(n, any);
  dense.A = Eigen::MatrixXd::Zero(rows, n);
  dense.c = Eigen::VectorXd::NullaryExpr(rows, any);
  dense.rho = Eigen::VectorXd::NullaryExpr(rows, [&] { return test::uniform(rng, 0.5, 5.0); });
  for (int k = 0; k < stages; ++k) {
    const Eigen::MatrixXd B = Eigen::MatrixXd::NullaryExpr(m, 2 * m, any);
    const int width = k + 1 < stages ? 2 * m : m;
    dense.H.block(k * m, k * m, width, width) += (B.transpose() * B).topLeftCorner(width, width);
    dense.H.block(k * m, k * m, m, m).diagonal().array() += 0.1;
  }
  qp.reset(stages);
  for (int k = 0; k < stages; ++k) {
    Eigen::Map<Eigen::MatrixXd>(qp.block(k), m, m) = dense.H.block(k * m, k * m, m, m);
    Eigen::Map<Eigen::VectorXd>(qp.g(k), m) = dense.g.segment(k * m, m);
    if (k + 1 < stages) {
      Eigen::Map<Eigen::MatrixXd>(qp.coupling(k), m, m) = dense.H.block(k * m, (k + 1) * m, m, m);
    }
  }
  for (int i = 0; i < rows; ++i) {
    const int stage = i % stages;
    const int width = stage + 1 < stages && i % 3 == 0 ? 2 * m : m;
    dense.A.row(i).segment(stage * m, width) = Eigen::RowVectorXd::NullaryExpr(width, any);
    double* a = qp.add_row(stage, dense.c[i], dense.rho[i]);
    Eigen::Map<Eigen::RowVectorXd>(a, width) = dense.A.row(i).segment(stage * m, width);
  }
  return dense;
}

Eigen::VectorXd solution(const StagewiseQp& qp) {
  Eigen::VectorXd p(qp.size() * qp.stages());
  for (int k = 0; k < qp.stages(); ++k) {
    p.segment(k * qp.size(), qp.size()) = Eigen::Map<const Eigen::VectorXd>(qp.p(k), qp.size());
  }
  return p;
}

double value(const Dense& dense, const Eigen::VectorXd& p) {
  const Eigen::VectorXd d = dense.A * p + dense.c;
  return 0.5 * p.dot(dense.H * p) + dense.g.dot(p) + dense.rho.dot((-d).cwiseMax(0.0));
}

// The conditions of Karush, Kuhn and Tucker, which a convex program's solution is known by.
TEST(StagewiseQp, MeetsTheOptimalityConditions) {
  test::Generator rng(1);
  for (const int m : {1, 2, 3, 4, 7}) {
    for (const int stages : {1, 2, 12}) {
      for (const int rows : {0, 1, 5 * stages}) {
        StagewiseQp qp(m);
        const Dense dense = random_program(rng, qp, stages, rows);
        ASSERT_TRUE(qp.solve(0.0, 1e-2));
        const Eigen::VectorXd p = solution(qp);
        Eigen::VectorXd z(rows);
        for (int i = 0; i < rows; ++i) {
          z[i] = qp.multiplier(i);
        }
        const Eigen::VectorXd d = dense.A * p + dense.c;
        EXPECT_LT((dense.H * p + dense.g - dense.A.transpose() * z).lpNorm<Eigen::Infinity>(),
                  1e-9);
        double violation = 0.0;
        for (int i = 0; i < rows; ++i) {
          EXPECT_GE(z[i], 0.0);
          EXPECT_LE(z[i], dense.rho[i]);
          EXPECT_LT(std::max(d[i], 0.0) * z[i], 1e-9);
          EXPECT_LT(std::max(-d[i], 0.0) * (dense.rho[i] - z[i]), 1e-9);
          violation += std::max(-d[i], 0.0);
        }
        EXPECT_NEAR(qp.violation_after(), violation, 1e-12);
        EXPECT_NEAR(qp.decrease(), value(dense, Eigen::VectorXd::Zero(p.size())) - value(dense, p),
                    1e-9);
        EXPECT_LT(qp.iterations(), 40);
      }
    }
  }
}

TEST(StagewiseQp, KnowsAnIndefiniteProgram) {
  test::Generator rng(2);
  StagewiseQp qp(3);
  random_program(rng, qp, 8, 10);
  EXPECT_TRUE(qp.is_convex(0.0));
  qp.block(5)[4] -= 30.0;
  EXPECT_FALSE(qp.is_convex(0.0));
  EXPECT_TRUE(qp.is_convex(40.0));
}

TEST(StagewiseQp, BreaksDownOnWhatIsNotFinite) {
  test::Generator rng(3);
  StagewiseQp qp(3);
  random_program(rng, qp, 4, 6);
  qp.g(2)[1] = std::nan("");
  EXPECT_FALSE(qp.solve(0.0, 1e-2));
}

TEST(StagewiseQp, DampingShortensTheStep) {
  test::Generator rng(4);
  StagewiseQp qp(3);
  const Dense dense = random_program(rng, qp, 6, 0);
  ASSERT_TRUE(qp.solve(2.0, 1e-2));
  Eigen::MatrixXd H = dense.H;
  H.diagonal().array() += 2.0;
  EXPECT_LT((solution(qp) + H.llt().solve(dense.g)).norm(), 1e-9);
}

}  // namespace
}  // namespace thing_kin
