#pragma once

#include "lanes.hpp"

namespace thing_kin::THING_KIN_LEVEL {

/// Angle of (cosine, sine), of any length, in [-pi, pi], within about two units in the last place;
/// 0 for (0, 0).
inline Lanes arc_tangent(const Lanes& sine, const Lanes& cosine) {
  constexpr double kPi = 0x1.921fb54442d18p+1;  // NOLINT(modernize-use-std-numbers): no includes
  constexpr double kTangentOfEighth = 0x1.a827999fcef32p-2;  // tan(pi/8)
  constexpr double kTiny = 0x1p-1000;

  const Lanes s = absolute(sine);
  const Lanes c = absolute(cosine);
  const LanesInt steep = s > c;
  const Lanes large = larger(larger(s, c), splat(kTiny));
  const Lanes small = select(steep, c, s);
  // The angle from the nearer axis, or from the diagonal.
  const LanesInt diagonal = small > kTangentOfEighth * large;
  const Lanes t = select(diagonal, small - large, small) / select(diagonal, small + large, large);

  // Interpolated at Chebyshev nodes on |t| <= tan(pi/8): within 2^-58 of atan(t)/t.
  const Lanes u = t * t;
  const Lanes u2 = u * u;
  const Lanes u4 = u2 * u2;
  const Lanes low = (-0x1.5555555555555p-2 + 0x1.9999999999953p-3 * u) +
                    u2 * (-0x1.249249248d7eep-3 + 0x1.c71c71c304b64p-4 * u);
  const Lanes middle = (-0x1.745d165df3ee7p-4 + 0x1.3b1392d9e64b0p-4 * u) +
                       u2 * (-0x1.110e880a643d8p-4 + 0x1.e19a13b800ab6p-5 * u);
  const Lanes high = (-0x1.ac7a937cce153p-5 + 0x1.74ddd3c6187b4p-5 * u) +
                     u2 * (-0x1.1b33b8784aa69p-5 + 0x1.0ad368c98424cp-6 * u);
  const Lanes rest = t * (u * (low + u4 * (middle + u4 * high)));

  // Then to the right octant, quadrant and half.
  const Lanes from_axis = select(diagonal, splat(kPi / 4), splat(0.0)) + (t + rest);
  const Lanes acute = select(steep, kPi / 2 - from_axis, from_axis);
  constexpr auto kSign = static_cast<long long>(0x8000000000000000ULL);
  const Lanes upper = select(cosine < 0.0, kPi - acute, acute);
  return as_numbers(as_bits(upper) | (as_bits(sine) & kSign));
}

}  // namespace thing_kin::THING_KIN_LEVEL
