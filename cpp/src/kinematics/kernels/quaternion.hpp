#pragma once

#include "column.hpp"

namespace thing_kin::THING_KIN_LEVEL {

struct Quaternion {
  Lanes w, x, y, z;
};

inline Quaternion where(const LanesInt& mask, const Quaternion& a, const Quaternion& b) {
  return {mask ? a.w : b.w, mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

inline Lanes square_root(const Lanes& v) {
  Lanes root = v;
  for (int lane = 0; lane < kLanes; ++lane) {
    root[lane] = __builtin_sqrt(v[lane]);
  }
  return root;
}

/// Row of 4 q q^T with the largest diagonal element, normalized; signs as lie/so3.hpp has them.
inline Quaternion quaternion_of(const Frame<Columns>& R, double half_turn_tolerance) {
  const Lanes ww = 1.0 + R.x.x + R.y.y + R.z.z;
  const Lanes xx = 1.0 + R.x.x - R.y.y - R.z.z;
  const Lanes yy = 1.0 - R.x.x + R.y.y - R.z.z;
  const Lanes zz = 1.0 - R.x.x - R.y.y + R.z.z;
  const Lanes wx = R.y.z - R.z.y;
  const Lanes wy = R.z.x - R.x.z;
  const Lanes wz = R.x.y - R.y.x;
  const Lanes xy = R.x.y + R.y.x;
  const Lanes xz = R.z.x + R.x.z;
  const Lanes yz = R.y.z + R.z.y;

  Quaternion q{ww, wx, wy, wz};
  Lanes largest = ww;
  q = where(xx > largest, {wx, xx, xy, xz}, q);
  largest = larger(xx, largest);
  q = where(yy > largest, {wy, xy, yy, yz}, q);
  largest = larger(yy, largest);
  q = where(zz > largest, {wz, xz, yz, zz}, q);
  largest = larger(zz, largest);

  const Lanes scale = 1.0 / square_root(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  q = {q.w * scale, q.x * scale, q.y * scale, q.z * scale};
  const LanesInt half_turn = absolute(q.w) <= half_turn_tolerance;
  const Lanes first =
      absolute(q.x) > half_turn_tolerance ? q.x : (absolute(q.y) > half_turn_tolerance ? q.y : q.z);
  const LanesInt negative = half_turn ? first < 0.0 : q.w < 0.0;
  q.w = half_turn ? splat(0.0) : q.w;
  return where(negative, {-q.w, -q.x, -q.y, -q.z}, q);
}

}  // namespace thing_kin::THING_KIN_LEVEL
