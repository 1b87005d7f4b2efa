#pragma once

#include "lanes.hpp"

extern "C" double sin(double) noexcept;
extern "C" double cos(double) noexcept;

namespace thing_kin::THING_KIN_LEVEL {

struct SinCos {
  Lanes sin, cos;
};

/// Up to here q is reduced with pi/2 in three parts, of which the first two times any quadrant
/// number are exact; beyond, by the C library.
inline constexpr double kLargestAngle = 5e5;

/// Sine and cosine of angles up to kLargestAngle, within about one unit in the last place.
inline SinCos sincos(const Lanes& angle) {
  constexpr double kQuadrantsPerRadian = 0x1.45f306dc9c883p-1;  // 2/pi
  constexpr double kHalfPi1 = 0x1.921fb544p+0;                  // 33 bits
  constexpr double kHalfPi2 = 0x1.0b4611a6p-34;                 // the next 33
  constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;
  constexpr double kRounder = 0x1.8p52;  // its last bits are whole numbers

  const Lanes rounded = angle * kQuadrantsPerRadian + kRounder;
  const LanesInt quadrant = as_bits(rounded);
  const Lanes k = rounded - kRounder;
  const Lanes r = ((angle - k * kHalfPi1) - k * kHalfPi2) - k * kHalfPi3;

  // Interpolated at Chebyshev nodes on |r| <= pi/4: within 2^-55 of sin(r)/r, 2^-59 of cos(r).
  const Lanes t = r * r;
  const Lanes t2 = t * t;
  const Lanes s = (-0x1.5555555555555p-3 + 0x1.1111111110bb1p-7 * t) +
                  t2 * ((-0x1.a01a019e8357dp-13 + 0x1.71de37961e4c6p-19 * t) +
                        t2 * (-0x1.ae600a926c89ap-26 + 0x1.5e0af186af739p-33 * t));
  const Lanes c = (0.041666666666666664 - 0.0013888888888887395 * t) +
                  t2 * ((2.4801587298763433e-05 - 2.7557317270560326e-07 * t) +
                        t2 * (2.0876146024689747e-09 - 1.1382614868556325e-11 * t));
  const Lanes sine = r + (r * t) * s;
  const Lanes cosine = 1.0 + t * (t * c - 0.5);

  const LanesInt odd = -(quadrant & 1);
  const LanesInt sine_sign = (quadrant & 2) << 62;
  const LanesInt cosine_sign = ((quadrant + 1) & 2) << 62;
  return {as_numbers(as_bits(select(odd, cosine, sine)) ^ sine_sign),
          as_numbers(as_bits(select(odd, sine, cosine)) ^ cosine_sign)};
}

/// The same for angles of any size.
inline SinCos sincos_of_any(const Lanes& angle) {
  SinCos result = sincos(angle);
  for (int lane = 0; lane < kLanes; ++lane) {
    if (angle[lane] > kLargestAngle || angle[lane] < -kLargestAngle) {
      result.sin[lane] = ::sin(angle[lane]);
      result.cos[lane] = ::cos(angle[lane]);
    }
  }
  return result;
}

}  // namespace thing_kin::THING_KIN_LEVEL
