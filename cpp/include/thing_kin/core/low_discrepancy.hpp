#pragma once

#include <array>
#include <cstdint>

#include "thing_kin/core/max_dof.hpp"

namespace thing_kin {

/// The additive sequence of Roberts (2018), x_k = frac(start + k alpha), alpha_j = phi^-(j+1) with
/// phi the root of phi^(n+1) = phi + 1: points that fill the unit cube evenly from the first on.
/// Whole-number arithmetic: equal on every machine, and point k needs no point before it.
class LowDiscrepancy {
 public:
  /// dimensions in [1, kMaxDof]. Another seed shifts the whole sequence (Cranley & Patterson).
  LowDiscrepancy(int dimensions, std::uint64_t seed) noexcept;

  /// Coordinate j of point k, [0, 1).
  double operator()(std::uint64_t k, int j) const noexcept {
    const auto i = static_cast<std::size_t>(j);
    return static_cast<double>((start_[i] + k * alpha_[i]) >> 11U) * 0x1p-53;
  }

 private:
  std::array<std::uint64_t, kMaxDof> alpha_;
  std::array<std::uint64_t, kMaxDof> start_;
};

}  // namespace thing_kin
