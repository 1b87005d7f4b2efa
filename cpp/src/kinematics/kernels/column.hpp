#pragma once

#include "lanes.hpp"

namespace thing_kin::THING_KIN_LEVEL {

/// A vector in space for one pose, padded to four numbers: one register, or two of the baseline.
#if THING_KIN_LANES >= 4
using Column = double __attribute__((vector_size(32)));
using UnalignedColumn = double __attribute__((vector_size(32), aligned(8)));

inline void read(const double* from, Column& to) {
  to = *reinterpret_cast<const UnalignedColumn*>(from);
}
inline void write(const Column& from, double* to) {
  *reinterpret_cast<UnalignedColumn*>(to) = from;
}

inline Column cross(const Column& a, const Column& b) {
  const Column a_yzx = __builtin_shufflevector(a, a, 1, 2, 0, 3);
  const Column b_yzx = __builtin_shufflevector(b, b, 1, 2, 0, 3);
  const Column c = a * b_yzx - a_yzx * b;
  return __builtin_shufflevector(c, c, 1, 2, 0, 3);
}
#else
struct Column {
  Lanes xy, z_pad;

  double operator[](int i) const { return i < 2 ? xy[i] : z_pad[i - 2]; }
};

inline Column operator+(const Column& a, const Column& b) {
  return {a.xy + b.xy, a.z_pad + b.z_pad};
}
inline Column operator-(const Column& a, const Column& b) {
  return {a.xy - b.xy, a.z_pad - b.z_pad};
}
inline Column operator-(const Column& a) { return {-a.xy, -a.z_pad}; }
inline Column operator*(double s, const Column& a) { return {s * a.xy, s * a.z_pad}; }

inline void read(const double* from, Column& to) { to = {load(from), load(from + 2)}; }
inline void write(const Column& from, double* to) {
  store(from.xy, to);
  store(from.z_pad, to + 2);
}

inline Column cross(const Column& a, const Column& b) {
  return {Lanes{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2]},
          Lanes{a[0] * b[1] - a[1] * b[0], 0.0}};
}
#endif

/// A vector in space for kLanes poses.
struct Columns {
  Lanes x, y, z;
};

inline Columns operator+(const Columns& a, const Columns& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Columns operator-(const Columns& a, const Columns& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Columns operator-(const Columns& a) { return {-a.x, -a.y, -a.z}; }
inline Columns operator*(const Lanes& s, const Columns& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Columns operator*(double s, const Columns& a) { return {s * a.x, s * a.y, s * a.z}; }

inline Columns cross(const Columns& a, const Columns& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline void read(const double* from, Columns& to) {
  to = {splat(from[0]), splat(from[1]), splat(from[2])};
}

/// A frame: its axes and its origin, of one pose or of kLanes poses.
template <typename C>
struct Frame {
  C x, y, z, origin;
};

template <typename C>
inline void read(const double* columns, Frame<C>& to) {
  read(columns, to.x);
  read(columns + 4, to.y);
  read(columns + 8, to.z);
  read(columns + 12, to.origin);
}

inline void write(const Frame<Column>& frame, double* columns) {
  write(frame.x, columns);
  write(frame.y, columns + 4);
  write(frame.z, columns + 8);
  write(frame.origin, columns + 12);
}

}  // namespace thing_kin::THING_KIN_LEVEL
