// What only C++ can see of the closed form: no heap, threads, and the arc tangent below it.

#include "thing_kin/inverse/closed_form_ik.hpp"

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/core/simd.hpp"
#include "thing_kin/kinematics/arc_tangent.hpp"
#include "thing_kin/kinematics/posture.hpp"
#include "thing_kin/model/robots.hpp"

namespace {
std::atomic<int> allocations{0};
}

// The sanitizers bring their own malloc, which must stay.
#if !defined(__SANITIZE_ADDRESS__)
extern "C" {
void* __libc_malloc(std::size_t size);  // NOLINT

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
}
#endif

namespace thing_kin {
namespace {

constexpr double kPi = std::numbers::pi;

/// A spherical wrist on three joints of no special kind: by a quartic.
Chain general_wrist() {
  std::vector<DhRow> rows(6);
  test::Generator rng(3);
  for (DhRow& row : rows) {
    row.d = test::uniform(rng, 0.1, 1.0);
    row.a = test::uniform(rng, 0.1, 1.0);
    row.alpha = test::uniform(rng, 0.5, 2.5);
    row.joint = JointType::kRevolute;
    row.limits = {-2 * kPi, 2 * kPi};
  }
  rows[3].a = rows[4].a = rows[4].d = 0.0;
  return Chain::from_dh(rows);
}

TEST(ClosedForm, NoHeap) {
  for (const Chain& chain : {robots::ur10(), general_wrist()}) {
    test::Generator rng(1);
    const Eigen::VectorXd q = test::random_vector(rng, 6);
    const SE3 reached = forward_kinematics(chain, q.data(), chain.tool());
    SE3 beyond = reached;
    beyond.translation *= 100.0;
    ClosedFormSolutions found, closest;
    const int before = allocations;
    const std::optional<ClosedFormIk> ik = ClosedFormIk::find(chain, chain.tool());
    ik->solve(reached, nullptr, found, {.seed = q.data()});
    ik->solve(beyond, nullptr, closest);
    EXPECT_EQ(allocations - before, 0);
    EXPECT_EQ(found.status, ClosedFormStatus::kSolved);
    EXPECT_LT((found.solutions[0].q - q).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_EQ(closest.status, ClosedFormStatus::kUnreachable);
    EXPECT_GT(closest.count, 0);
  }
}

TEST(ClosedForm, OneObjectForManyThreads) {
  const Chain chain = robots::thing();
  const std::optional<ClosedFormIk> ik = ClosedFormIk::find(chain, chain.tool());
  ASSERT_TRUE(ik);
  test::Generator rng(2);
  std::vector<Eigen::VectorXd> q;
  for (int i = 0; i < 500; ++i) {
    q.push_back(test::random_vector(rng, 9));
  }
  const auto solve_all = [&](std::vector<ClosedFormSolutions>& out) {
    for (std::size_t i = 0; i < q.size(); ++i) {
      const SE3 T = forward_kinematics(chain, q[i].data(), chain.tool());
      ik->solve(T, q[i].data() + 6, out[i], {.seed = q[i].data()});
    }
  };
  std::vector<std::vector<ClosedFormSolutions>> all(4, std::vector<ClosedFormSolutions>(q.size()));
  std::vector<std::jthread> threads;
  for (auto& out : all) {
    threads.emplace_back([&] { solve_all(out); });
  }
  threads.clear();
  for (std::size_t i = 0; i < q.size(); ++i) {
    for (const auto& out : all) {
      ASSERT_EQ(out[i].count, all[0][i].count);
      for (int k = 0; k < out[i].count; ++k) {
        const auto at = static_cast<std::size_t>(k);
        ASSERT_EQ(out[i].solutions[at].q, all[0][i].solutions[at].q);
      }
    }
  }
}

TEST(ClosedForm, NotFiniteIsUnreachable) {
  const Chain chain = robots::ur5();
  SE3 T;
  T.translation[1] = std::nan("");
  ClosedFormSolutions found;
  ClosedFormIk::find(chain, chain.tool())->solve(T, nullptr, found);
  EXPECT_EQ(found.count, 0);
  EXPECT_EQ(found.status, ClosedFormStatus::kUnreachable);
}

TEST(ArcTangent, IsThatOfTheLibraryAtEveryLevel) {
  std::vector<double> sine, cosine;
  for (int i = -4000; i <= 4000; ++i) {
    const double angle = kPi * i / 4000.0;
    sine.push_back(std::sin(angle));
    cosine.push_back(std::cos(angle));
  }
  for (const double s : {0.0, -0.0, 1e-300, -1e-20, 1.0, -1.0, 1e200}) {
    for (const double c : {0.0, 1e-300, -1e-20, 1.0, -1.0, -1e200}) {
      sine.push_back(s);
      cosine.push_back(c);
    }
  }
  const SimdLevel best = best_simd_level();
  for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (level > best) {
      continue;
    }
    use_simd_level(level);
    std::vector<double> angle(sine.size());
    arc_tangents(sine.data(), cosine.data(), static_cast<long>(sine.size()), angle.data());
    for (std::size_t i = 0; i < sine.size(); ++i) {
      const double expected = std::atan2(sine[i], cosine[i]);
      EXPECT_LE(std::abs(angle[i] - expected), 2e-16 * std::max(std::abs(expected), 1.0) * 2.0)
          << sine[i] << ", " << cosine[i];
    }
  }
  use_simd_level(best);
}

}  // namespace
}  // namespace thing_kin
