#include "thing_kin/core/random.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace thing_kin {
namespace {

// Reference values: SplitMix64 of seed 0 as published; xoshiro256++ worked out with integers of
// any size.
TEST(Random, MixesAsPublished) {
  EXPECT_EQ(mix_bits(0), 0xE220A8397B1DCDAFULL);
  EXPECT_EQ(mix_bits(0x9E3779B97F4A7C15ULL), 0x6E789E6AA1B965F4ULL);
}

TEST(Random, StreamsOfDifferentKeysDiffer) {
  RandomStream a(mix_keys(1, 2));
  RandomStream b(mix_keys(1, 3));
  RandomStream c(mix_keys(2, 2));
  RandomStream again(mix_keys(1, 2));
  const std::uint64_t first = a.bits();
  EXPECT_NE(first, b.bits());
  EXPECT_NE(first, c.bits());
  EXPECT_EQ(first, again.bits());
}

TEST(Random, UniformNumbersAreUniform) {
  RandomStream random(5);
  constexpr int kDraws = 400'000;
  std::vector<int> bins(16);
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++bins[static_cast<std::size_t>(16.0 * u)];
  }
  double chi_square = 0.0;
  for (const int count : bins) {
    const double expected = kDraws / 16.0;
    chi_square += (count - expected) * (count - expected) / expected;
  }
  EXPECT_LT(chi_square, 37.7);  // 15 degrees of freedom, 99.9 %
}

TEST(Random, NormalNumbersAreNormal) {
  RandomStream random(6);
  constexpr int kDraws = 400'000;
  double sum = 0.0;
  double squares = 0.0;
  double fourth = 0.0;
  double lagged = 0.0;
  double before = 0.0;
  int beyond = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
    lagged += x * before;
    before = x;
    beyond += std::abs(x) > 1.959964 ? 1 : 0;
  }
  // Four standard deviations of each.
  EXPECT_NEAR(sum / kDraws, 0.0, 0.0064);
  EXPECT_NEAR(squares / kDraws, 1.0, 0.009);
  EXPECT_NEAR(fourth / kDraws, 3.0, 0.063);
  EXPECT_NEAR(lagged / kDraws, 0.0, 0.0064);
  EXPECT_NEAR(static_cast<double>(beyond) / kDraws, 0.05, 0.0014);
}

}  // namespace
}  // namespace thing_kin
