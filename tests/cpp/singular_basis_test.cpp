#include "thing_kin/linalg/singular_basis.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "random_chain.hpp"

namespace thing_kin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kRounding = 2.3e-16;

MatrixXd draw(test::Generator& rng, Index m, Index n) {
  return MatrixXd::NullaryExpr(m, n, [&] { return test::uniform(rng, -1, 1); });
}

void expect_orthonormal(const MatrixXd& V) {
  EXPECT_LT((V.transpose() * V - MatrixXd::Identity(V.cols(), V.cols())).norm(), 1e-13);
}

TEST(SingularBasis, AgreesWithEigenOnEveryShape) {
  test::Generator rng(1);
  for (const auto& [m, n] : {std::pair<Index, Index>{1, 1}, {2, 5}, {5, 2}, {7, 7}, {200, 40}}) {
    const MatrixXd A = draw(rng, m, n);
    const SingularBasis basis = singular_basis(A);
    const Eigen::VectorXd sigma = Eigen::JacobiSVD<MatrixXd>(A).singularValues();
    const Index k = std::min(m, n);
    EXPECT_LT((basis.sigma.head(k) - sigma).norm(), 40 * kRounding * A.norm());
    EXPECT_EQ(basis.sigma.tail(n - k).norm(), 0.0);
    expect_orthonormal(basis.v);
    const MatrixXd image = A * basis.v;  // columns of length sigma, orthogonal
    EXPECT_LT((image.colwise().norm().transpose() - basis.sigma).norm(), 1e-13 * A.norm());
    const MatrixXd gram = image.transpose() * image;
    EXPECT_LT((gram - MatrixXd(gram.diagonal().asDiagonal())).norm(), 1e-12 * A.squaredNorm());
  }
}

// Ranks that A^T A would not show: columns scaled over twelve decades, which is what the base's ten
// meters and a scale's percents are beside micrometers of noise.
TEST(SingularBasis, KnowsTheRankOfBadlyScaledColumns) {
  test::Generator rng(2);
  for (int rank = 0; rank <= 12; ++rank) {
    MatrixXd A = MatrixXd::Zero(90, 12);
    if (rank > 0) {
      A = draw(rng, 90, rank) * draw(rng, rank, 12);
    }
    const SingularBasis basis = singular_basis(A);
    expect_orthonormal(basis.v);
    EXPECT_EQ((basis.sigma.array() > 1e-12).count(), rank);
    EXPECT_LT((A * basis.v.rightCols(12 - rank)).norm(), 1e-12);
  }
}

// Relative accuracy of the small ones: of A = Q D with orthonormal Q they are D's entries.
TEST(SingularBasis, SmallValuesKeepTheirDigits) {
  test::Generator rng(3);
  const Eigen::HouseholderQR<MatrixXd> qr(draw(rng, 60, 8));
  const MatrixXd Q = qr.householderQ() * MatrixXd::Identity(60, 8);
  Eigen::VectorXd scales(8);
  scales << 1e9, 3e-7, 1e2, 1.0, 1e-12, 5e5, 2e-3, 1e-9;
  const SingularBasis basis = singular_basis(Q * scales.asDiagonal());
  std::ranges::sort(scales, std::greater<>());
  for (Index i = 0; i < 8; ++i) {
    EXPECT_NEAR(basis.sigma[i] / scales[i], 1.0, 1e-13) << i;
  }
  expect_orthonormal(basis.v);
}

TEST(SingularBasis, ExtremeNumbers) {
  test::Generator rng(4);
  for (const double unit : {1e-300, 1e-150, 1e150, 1e300}) {
    const MatrixXd A = draw(rng, 9, 4);
    const SingularBasis here = singular_basis(A);
    const SingularBasis there = singular_basis(unit * A);
    EXPECT_LT((there.sigma / unit - here.sigma).norm(), 1e-13);
    expect_orthonormal(there.v);
  }
  EXPECT_EQ(singular_basis(MatrixXd::Zero(5, 3)).sigma.norm(), 0.0);
  EXPECT_EQ(singular_basis(MatrixXd(0, 3)).v, MatrixXd::Identity(3, 3));
}

}  // namespace
}  // namespace thing_kin
