// Least squares in strict order against all faces of the box, tried one by one.

#include "thing_kin/linalg/hierarchical_qp.hpp"

#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "random_chain.hpp"

namespace thing_kin {
namespace {

struct Row {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
};

struct Hierarchy {
  Eigen::VectorXd lower, upper, wish;
  std::vector<Row> levels;
};

Eigen::MatrixXd random_matrix(test::Generator& rng, Eigen::Index rows, Eigen::Index cols) {
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return test::uniform(rng, -1, 1); });
}

// The recursion over the variables that `free` lists, the others as they are.
Eigen::VectorXd solve_on_face(const Hierarchy& h, Eigen::VectorXd x, const std::vector<int>& free) {
  const auto n = x.size();
  Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    Z(free[i], static_cast<Eigen::Index>(i)) = 1.0;
    x[free[i]] = 0.0;
  }
  std::vector<Row> levels = h.levels;
  levels.push_back({Eigen::MatrixXd::Identity(n, n), h.wish});
  for (const Row& level : levels) {
    if (Z.cols() == 0) {
      break;
    }
    const Eigen::MatrixXd M = level.A * Z;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Index rank = 0;
    while (rank < svd.singularValues().size() && svd.singularValues()[rank] > 1e-10) {
      ++rank;
    }
    const Eigen::VectorXd r = svd.matrixU().leftCols(rank).transpose() * (level.b - level.A * x);
    x += Z * (svd.matrixV().leftCols(rank) *
              (r.array() / svd.singularValues().head(rank).array()).matrix());
    Z = (Z * svd.matrixV().rightCols(Z.cols() - rank)).eval();
  }
  return x;
}

std::vector<double> costs(const Hierarchy& h, const Eigen::VectorXd& x) {
  std::vector<double> all;
  for (const Row& level : h.levels) {
    all.push_back((level.A * x - level.b).norm());
  }
  all.push_back((x - h.wish).norm());
  return all;
}

bool better(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(a[i] - b[i]) > 1e-9) {
      return a[i] < b[i];
    }
  }
  return false;
}

// The best of the optima of all faces: on its own face the solution is one.
Eigen::VectorXd brute_force(const Hierarchy& h) {
  const auto n = static_cast<int>(h.lower.size());
  int faces = 1;
  for (int i = 0; i < n; ++i) {
    faces *= 3;
  }
  std::optional<Eigen::VectorXd> best;
  for (int face = 0; face < faces; ++face) {
    Eigen::VectorXd x(n);
    std::vector<int> free;
    int code = face;
    bool finite = true;
    for (int i = 0; i < n; ++i, code /= 3) {
      x[i] = code % 3 == 0 ? 0.0 : code % 3 == 1 ? h.lower[i] : h.upper[i];
      finite = finite && std::isfinite(x[i]);
      if (code % 3 == 0) {
        free.push_back(i);
      }
    }
    if (!finite) {
      continue;
    }
    x = solve_on_face(h, x, free);
    const bool inside = (x.array() >= h.lower.array() - 1e-10).all() &&
                        (x.array() <= h.upper.array() + 1e-10).all();
    if (inside && (!best || better(costs(h, x), costs(h, *best)))) {
      best = x;
    }
  }
  return *best;
}

HierarchicalQp solve(const Hierarchy& h, const Eigen::VectorXd& guess) {
  HierarchicalQp qp;
  qp.begin(h.lower, h.upper, guess);
  for (const Row& level : h.levels) {
    qp.minimize(level.A, level.b, {});
  }
  qp.nearest_to(h.wish);
  qp.finish();
  return qp;
}

Hierarchy random_hierarchy(test::Generator& rng, int kind) {
  const int n = 4;
  Hierarchy h{test::random_vector(rng, n, 1.0), {}, Eigen::VectorXd::Zero(n), {}};
  h.upper = h.lower + test::random_vector(rng, n, 1.0).cwiseAbs();
  if (kind % 3 == 1) {
    h.upper[kind % n] = h.lower[kind % n];
  }
  if (kind % 5 == 2) {
    h.lower[(kind + 1) % n] = -kInfinity;
  }
  if (kind % 2 == 0) {
    h.wish = test::random_vector(rng, n, 2.0);
  }
  for (const int rows : {1 + kind % 3, 2, 1}) {
    h.levels.push_back({random_matrix(rng, rows, n), test::random_vector(rng, rows, 3.0)});
  }
  if (kind % 4 == 3) {
    h.levels[1] = h.levels[0];                                           // said twice
    h.levels[2] = {h.levels[0].A.topRows(1), Eigen::VectorXd::Ones(1)};  // and contradicted
  }
  if (kind % 7 == 5) {
    h.levels[0].A.row(0).setZero();
    h.levels[1].A.bottomRows(1) = h.levels[1].A.topRows(1).eval();
  }
  return h;
}

TEST(HierarchicalQp, IsTheBestOfAllFaces) {
  test::Generator rng(1);
  for (int i = 0; i < 3000; ++i) {
    const Hierarchy h = random_hierarchy(rng, i);
    const Eigen::VectorXd best = brute_force(h);
    const HierarchicalQp qp = solve(h, test::random_vector(rng, 4, 1.0));
    ASSERT_TRUE(qp.converged()) << i;
    EXPECT_TRUE((qp.x().array() >= h.lower.array()).all() &&
                (qp.x().array() <= h.upper.array()).all());
    const std::vector<double> ours = costs(h, qp.x());
    const std::vector<double> theirs = costs(h, best);
    for (std::size_t k = 0; k < ours.size(); ++k) {
      EXPECT_NEAR(ours[k], theirs[k], 1e-7) << "problem " << i << " level " << k;
    }
    EXPECT_LT((qp.x() - best).norm(), 1e-6) << i;
  }
}

TEST(HierarchicalQp, TheGuessDoesNotMatter) {
  test::Generator rng(2);
  for (int i = 0; i < 500; ++i) {
    const Hierarchy h = random_hierarchy(rng, i);
    const Eigen::VectorXd one = solve(h, test::random_vector(rng, 4, 1.0)).x();
    const Eigen::VectorXd other = solve(h, test::random_vector(rng, 4, 10.0)).x();
    EXPECT_LT((one - other).norm(), 1e-7) << i;
  }
}

TEST(HierarchicalQp, LowerLevelsChangeNothingAbove) {
  test::Generator rng(3);
  for (int i = 0; i < 500; ++i) {
    const int n = 9;
    Hierarchy h{-test::random_vector(rng, n, 0.1).cwiseAbs(),
                test::random_vector(rng, n, 0.1).cwiseAbs(),
                Eigen::VectorXd::Zero(n),
                {}};
    for (const int rows : {3, 3, 4, 9}) {
      h.levels.push_back({random_matrix(rng, rows, n), test::random_vector(rng, rows, 0.5)});
    }
    Hierarchy first{h.lower, h.upper, h.wish, {}};
    for (const Row& level : h.levels) {
      first.levels.push_back(level);
      const Eigen::VectorXd alone = solve(first, Eigen::VectorXd::Zero(n)).x();
      const Eigen::VectorXd all = solve(h, Eigen::VectorXd::Zero(n)).x();
      EXPECT_LT((level.A * (alone - all)).norm(), 1e-10) << i;
    }
  }
}

// Intervals: the first order condition, the gradient of half the squared excess.
TEST(HierarchicalQp, IntervalsAreKeptOrMissedByAsLittleAsCanBe) {
  test::Generator rng(4);
  int infeasible = 0;
  for (int i = 0; i < 1000; ++i) {
    const int n = 5;
    const Eigen::VectorXd lower = Eigen::VectorXd::Constant(n, -1.0);
    const Eigen::VectorXd upper = Eigen::VectorXd::Constant(n, 1.0);
    const SmallMatrix C = random_matrix(rng, 4, n);
    const SmallVector l = test::random_vector(rng, 4, 1.5);
    const SmallVector u = l + SmallVector::Constant(4, i % 3 == 0 ? kInfinity : 0.5);
    const SmallMatrix A = random_matrix(rng, 3, n);
    const SmallVector b = test::random_vector(rng, 3, 3.0);
    HierarchicalQp qp;
    qp.begin(lower, upper, test::random_vector(rng, n, 1.0));
    qp.keep(C, l, u);
    const Eigen::VectorXd before = C * qp.x();
    const Eigen::VectorXd excess = before - before.cwiseMax(l).cwiseMin(u);
    const Eigen::VectorXd gradient = C.transpose() * excess;
    const Eigen::VectorXd back = (qp.x() - gradient).cwiseMax(lower).cwiseMin(upper) - qp.x();
    EXPECT_LT(back.norm(), 1e-9) << i;
    infeasible += excess.norm() > 1e-6 ? 1 : 0;
    qp.minimize(A, b, {});
    qp.nearest_to(JointVector::Zero(n));
    qp.finish();
    const Eigen::VectorXd after = C * qp.x();
    const Eigen::VectorXd still = after - after.cwiseMax(l).cwiseMin(u);
    EXPECT_LT((still - excess).norm(), 1e-10) << i;
    EXPECT_TRUE(qp.converged());
  }
  EXPECT_GT(infeasible, 100);
  EXPECT_LT(infeasible, 900);
}

TEST(HierarchicalQp, HugeAndEmptyProblemsEnd) {
  const int n = 32;
  test::Generator rng(5);
  for (const double size : {0.0, 1e-300, 1e12, 1e100}) {
    HierarchicalQp qp;
    qp.begin(JointVector::Constant(n, -1e-3), JointVector::Constant(n, 1e-3), JointVector::Zero(n));
    qp.keep(SmallMatrix::Zero(2, n), SmallVector::Ones(2), SmallVector::Ones(2));
    qp.minimize(SmallMatrix::Zero(3, n), SmallVector::Ones(3), {});
    qp.minimize(random_matrix(rng, 32, n), size * SmallVector::Ones(32), {1e-4, nullptr});
    qp.nearest_to(JointVector::Constant(n, size));
    qp.finish();
    EXPECT_LE(qp.x().cwiseAbs().maxCoeff(), 1e-3);
  }
}

}  // namespace
}  // namespace thing_kin
