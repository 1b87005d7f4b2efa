#pragma once

#include <gtest/gtest.h>

#include "thing_kin/core/simd.hpp"

namespace thing_kin::test {

/// A test that runs with each level of instructions this processor has.
class EveryLevel : public testing::TestWithParam<SimdLevel> {
 protected:
  void SetUp() override {
    if (GetParam() > best_simd_level()) {
      GTEST_SKIP() << "this processor has no " << to_string(GetParam());
    }
    use_simd_level(GetParam());
  }
  void TearDown() override { use_simd_level(best_simd_level()); }
};

inline auto every_level() {
  return testing::Values(SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512);
}

}  // namespace thing_kin::test
