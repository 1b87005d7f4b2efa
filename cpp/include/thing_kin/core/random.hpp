#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace thing_kin {

/// Spreads the bits of a number over all of its 64: a step of SplitMix64 (Steele, Lea and Flood,
/// 2014).
constexpr std::uint64_t mix_bits(std::uint64_t x) noexcept {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

/// A key made of another and of what it is for: independent streams of one seed.
constexpr std::uint64_t mix_keys(std::uint64_t key, std::uint64_t purpose) noexcept {
  return mix_bits(key ^ mix_bits(purpose));
}

/// Random numbers that are the same on every machine: xoshiro256++ (Blackman and Vigna, 2019), and
/// normal ones by Marsaglia's polar method, which the standard library leaves open.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t key) noexcept {
    for (std::uint64_t& word : state_) {
      key += 0x9E3779B97F4A7C15ULL;
      word = mix_bits(key);
    }
  }

  std::uint64_t bits() noexcept {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17U;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// In [0, 1), a multiple of 2^-53.
  double uniform() noexcept { return static_cast<double>(bits() >> 11U) * 0x1p-53; }

  /// Mean 0, variance 1.
  double normal() noexcept {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double u = 0.0;
    double v = 0.0;
    double square = 0.0;
    do {
      u = 2.0 * uniform() - 1.0;
      v = 2.0 * uniform() - 1.0;
      square = u * u + v * v;
    } while (square >= 1.0 || square == 0.0);
    const double scale = std::sqrt(-2.0 * std::log(square) / square);
    spare_ = v * scale;
    has_spare_ = true;
    return u * scale;
  }

 private:
  std::array<std::uint64_t, 4> state_{};
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace thing_kin
