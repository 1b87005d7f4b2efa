#include "thing_kin/linalg/svd.hpp"

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "random_chain.hpp"

namespace thing_kin {
namespace {

SmallMatrix random_matrix(test::Generator& rng, Eigen::Index m, Eigen::Index n) {
  return SmallMatrix::NullaryExpr(m, n, [&] { return test::uniform(rng, -1, 1); });
}

// Orthonormal factors that multiply back to A, whatever its rank.
void expect_decomposes(const SmallMatrix& A, const Svd& svd) {
  const Eigen::Index k = std::min(A.rows(), A.cols());
  const double tolerance = 40 * 2.3e-16 * std::max(1e-300, A.norm());
  ASSERT_EQ(svd.u.cols(), k);
  ASSERT_EQ(svd.v.cols(), A.cols());
  const SmallMatrix back = svd.u * svd.sigma.asDiagonal() * svd.thin_v().transpose();
  EXPECT_LT((back - A).norm(), tolerance);
  EXPECT_LT((svd.u.transpose() * svd.u - SmallMatrix::Identity(k, k)).norm(), 1e-13);
  EXPECT_LT((svd.v.transpose() * svd.v - SmallMatrix::Identity(A.cols(), A.cols())).norm(), 1e-13);
  for (Eigen::Index i = 0; i < k; ++i) {
    EXPECT_GE(svd.sigma[i], 0.0);
    EXPECT_GE(svd.sigma[std::max<Eigen::Index>(0, i - 1)], svd.sigma[i]);
  }
}

TEST(Svd, AgreesWithEigenOnEveryShape) {
  test::Generator rng(1);
  Svd svd;
  for (int m = 1; m <= 12; ++m) {
    for (int n = 1; n <= 12; ++n) {
      const SmallMatrix A = random_matrix(rng, m, n);
      decompose(A, svd);
      expect_decomposes(A, svd);
      const Eigen::MatrixXd dense = A;
      const Eigen::VectorXd sigma = Eigen::JacobiSVD<Eigen::MatrixXd>(dense).singularValues();
      EXPECT_LT((svd.sigma - sigma).norm(), 20 * 2.3e-16 * A.norm());
      EXPECT_EQ(svd.rank, std::min(m, n));
    }
  }
}

TEST(Svd, KnowsTheRank) {
  test::Generator rng(2);
  Svd svd;
  for (int rank = 0; rank <= 6; ++rank) {
    for (int i = 0; i < 50; ++i) {
      SmallMatrix A = SmallMatrix::Zero(6, 9);
      if (rank > 0) {
        A = random_matrix(rng, 6, rank) * random_matrix(rng, rank, 9);
      }
      decompose(A, svd);
      expect_decomposes(A, svd);
      EXPECT_EQ(svd.rank, rank);
      const SmallMatrix Z = svd.v.rightCols(9 - rank);
      EXPECT_LT((A * Z).norm(), 1e-13);
    }
  }
}

TEST(Svd, NoiseBelowTheScaleIsNoRank) {
  test::Generator rng(3);
  Svd svd;
  const SmallMatrix noise = 1e-16 * random_matrix(rng, 3, 3);
  decompose(noise, svd);
  EXPECT_EQ(svd.rank, 3);
  decompose(noise, svd, 1.0);
  EXPECT_EQ(svd.rank, 0);
}

TEST(Svd, ZeroRowsAndEqualColumns) {
  Svd svd;
  SmallMatrix A = SmallMatrix::Zero(6, 9);
  A.row(2).setOnes();
  A(4, 4) = 1e-200;
  decompose(A, svd);
  expect_decomposes(A, svd);
  decompose(SmallMatrix::Ones(5, 5), svd);
  expect_decomposes(SmallMatrix::Ones(5, 5), svd);
  EXPECT_EQ(svd.rank, 1);
  decompose(SmallMatrix::Identity(6, 6), svd);
  EXPECT_EQ(svd.rank, 6);
  EXPECT_LT((svd.sigma - SmallVector::Ones(6)).norm(), 1e-15);
}

TEST(Svd, SmallSingularValuesKeepRelativeAccuracy) {
  // Graded columns: an ordinary SVD loses all digits of the last ones.
  test::Generator rng(4);
  Svd svd;
  SmallVector scales(6);
  scales << 1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15;
  const SmallMatrix A = SmallMatrix(random_matrix(rng, 9, 6) * scales.asDiagonal());
  decompose(A, svd);
  using Extended = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Extended exact = A.cast<long double>();
  const auto sigma = Eigen::JacobiSVD<Extended>(exact).singularValues();
  for (Eigen::Index i = 0; i < 5; ++i) {
    EXPECT_NEAR(svd.sigma[i] / static_cast<double>(sigma[i]), 1.0, 1e-13) << i;
  }
}

TEST(Svd, ExtremeScales) {
  test::Generator rng(5);
  Svd svd;
  for (const double scale : {1e-300, 1e-150, 1e150, 1e300}) {
    const SmallMatrix A = scale * random_matrix(rng, 6, 9);
    decompose(A, svd);
    EXPECT_EQ(svd.rank, 6);
    const SmallMatrix back = svd.u * (svd.sigma / scale).asDiagonal() * svd.thin_v().transpose();
    EXPECT_LT((back - A / scale).norm(), 1e-13);
  }
}

TEST(Svd, LargestSize) {
  test::Generator rng(6);
  Svd svd;
  const SmallMatrix A = random_matrix(rng, kMaxDof, kMaxDof);
  decompose(A, svd);
  expect_decomposes(A, svd);
}

}  // namespace
}  // namespace thing_kin
