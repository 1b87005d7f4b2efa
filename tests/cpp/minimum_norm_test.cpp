#include "thing_kin/linalg/minimum_norm.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/linalg/pseudoinverse.hpp"

namespace thing_kin {
namespace {

SmallMatrix random_matrix(test::Generator& rng, Eigen::Index m, Eigen::Index n) {
  return SmallMatrix::NullaryExpr(m, n, [&] { return test::uniform(rng, -1, 1); });
}

TEST(MinimumNorm, EqualsTheInverseBySingularValues) {
  test::Generator rng(1);
  MinimumNorm fast;
  Svd svd;
  int factored = 0;
  for (int m = 1; m <= 8; ++m) {
    for (int n = m; n <= 12; ++n) {
      const SmallMatrix A = random_matrix(rng, m, n);
      decompose(A, svd);
      if (!fast.factor(A)) {
        EXPECT_LT(svd.sigma[m - 1], 1e-4 * svd.sigma[0]);
        continue;
      }
      ++factored;
      const double tolerance = 1e-14 * svd.sigma[0] / (svd.sigma[m - 1] * svd.sigma[m - 1]);
      const SmallMatrix expected = pseudoinverse(svd, exact_gains(svd));
      EXPECT_LT((fast.pseudoinverse() - expected).norm(), 10 * tolerance);
      const SmallVector e = test::random_vector(rng, m);
      EXPECT_LT((fast.solve(e) - expected * e).norm(), 100 * tolerance);
      const SmallMatrix Z = fast.null_space();
      EXPECT_LT((A * Z).norm(), 1e-14);
      EXPECT_LT((Z.transpose() * Z - SmallMatrix::Identity(n - m, n - m)).norm(), 1e-14);
    }
  }
  EXPECT_GT(factored, 50);
}

TEST(MinimumNorm, LeavesDoubtfulMatricesToTheSingularValues) {
  test::Generator rng(2);
  MinimumNorm fast;
  SmallMatrix A = random_matrix(rng, 6, 9);
  EXPECT_TRUE(fast.factor(A));
  A.row(5) = A.row(4);
  EXPECT_FALSE(fast.factor(A));
  A.row(5) *= 1.0 + 1e-9;
  EXPECT_FALSE(fast.factor(A));
  EXPECT_FALSE(fast.factor(random_matrix(rng, 9, 6)));
  EXPECT_FALSE(fast.factor(SmallMatrix::Zero(6, 9)));
}

TEST(MinimumNorm, ScalesExactly) {
  test::Generator rng(3);
  MinimumNorm fast;
  const SmallMatrix A = random_matrix(rng, 6, 9);
  ASSERT_TRUE(fast.factor(A));
  const SmallMatrix inverse = fast.pseudoinverse();
  for (const int exponent : {-900, -3, 5, 900}) {
    ASSERT_TRUE(fast.factor(std::ldexp(1.0, exponent) * A));
    EXPECT_EQ(fast.pseudoinverse(), SmallMatrix(std::ldexp(1.0, -exponent) * inverse));
  }
}

}  // namespace
}  // namespace thing_kin
