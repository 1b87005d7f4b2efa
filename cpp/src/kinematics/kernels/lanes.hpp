#pragma once

// Vectors of the width of one instruction set, by the compilers' vector extension. Compiled once
// for each level (cpp/CMakeLists.txt) into a namespace of its own, THING_KIN_LEVEL; to include
// anything with inline functions here would let the linker mix the levels up.

namespace thing_kin::THING_KIN_LEVEL {

inline constexpr int kLanes = THING_KIN_LANES;

using Lanes = double __attribute__((vector_size(8 * THING_KIN_LANES)));
using LanesInt = long long __attribute__((vector_size(8 * THING_KIN_LANES)));
using Unaligned = double __attribute__((vector_size(8 * THING_KIN_LANES), aligned(8)));

inline Lanes splat(double value) { return Lanes{} + value; }
inline Lanes load(const double* from) { return *reinterpret_cast<const Unaligned*>(from); }
inline void store(const Lanes& v, double* to) { *reinterpret_cast<Unaligned*>(to) = v; }

inline LanesInt as_bits(const Lanes& v) { return __builtin_bit_cast(LanesInt, v); }
inline Lanes as_numbers(const LanesInt& v) { return __builtin_bit_cast(Lanes, v); }

inline Lanes absolute(const Lanes& v) {
  constexpr long long kAllButSign = 0x7fffffffffffffff;
  return as_numbers(as_bits(v) & kAllButSign);
}

inline Lanes larger(const Lanes& a, const Lanes& b) { return a > b ? a : b; }

/// Lanes of `a` where all bits of the mask are set, of `b` where none is.
inline Lanes select(const LanesInt& mask, const Lanes& a, const Lanes& b) {
  return as_numbers((mask & as_bits(a)) | (~mask & as_bits(b)));
}

/// Whether one of `count` numbers is larger than `limit` or smaller than -limit, or NaN. Without a
/// sign, the bits of numbers are ordered as the numbers are.
inline bool any_beyond(const double* numbers, long count, double limit) {
  const LanesInt most = as_bits(splat(limit));
  LanesInt beyond{};  // negative where one is
  long i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    beyond |= most - as_bits(absolute(load(numbers + i)));
  }
  long long found = 0;
  for (; i < count; ++i) {
    found |= most[0] - as_bits(absolute(splat(numbers[i])))[0];
  }
  for (int lane = 0; lane < kLanes; ++lane) {
    found |= beyond[lane];
  }
  return found < 0;
}

/// Every stride-th number from `from` on.
inline Lanes gather(const double* from, long stride) {
#if THING_KIN_LANES == 8
  return Lanes{from[0],          from[stride],     from[2 * stride], from[3 * stride],
               from[4 * stride], from[5 * stride], from[6 * stride], from[7 * stride]};
#elif THING_KIN_LANES == 4
  return Lanes{from[0], from[stride], from[2 * stride], from[3 * stride]};
#else
  return Lanes{from[0], from[stride]};
#endif
}

// One butterfly of a transposition: swaps the odd blocks of `a` with the even blocks of `b`.
#if THING_KIN_LANES == 8
inline void swap_blocks(Lanes& a, Lanes& b, int size) {
  const Lanes u = a;
  const Lanes v = b;
  switch (size) {
    case 1:
      a = __builtin_shufflevector(u, v, 0, 8, 2, 10, 4, 12, 6, 14);
      b = __builtin_shufflevector(u, v, 1, 9, 3, 11, 5, 13, 7, 15);
      break;
    case 2:
      a = __builtin_shufflevector(u, v, 0, 1, 8, 9, 4, 5, 12, 13);
      b = __builtin_shufflevector(u, v, 2, 3, 10, 11, 6, 7, 14, 15);
      break;
    default:
      a = __builtin_shufflevector(u, v, 0, 1, 2, 3, 8, 9, 10, 11);
      b = __builtin_shufflevector(u, v, 4, 5, 6, 7, 12, 13, 14, 15);
  }
}
#elif THING_KIN_LANES == 4
inline void swap_blocks(Lanes& a, Lanes& b, int size) {
  const Lanes u = a;
  const Lanes v = b;
  if (size == 1) {
    a = __builtin_shufflevector(u, v, 0, 4, 2, 6);
    b = __builtin_shufflevector(u, v, 1, 5, 3, 7);
  } else {
    a = __builtin_shufflevector(u, v, 0, 1, 4, 5);
    b = __builtin_shufflevector(u, v, 2, 3, 6, 7);
  }
}
#else
inline void swap_blocks(Lanes& a, Lanes& b, int /*size*/) {
  const Lanes u = a;
  const Lanes v = b;
  a = __builtin_shufflevector(u, v, 0, 2);
  b = __builtin_shufflevector(u, v, 1, 3);
}
#endif

/// kLanes vectors as a square matrix, transposed in place.
inline void transpose(Lanes* square) {
#pragma GCC unroll 4
  for (int size = 1; size < kLanes; size *= 2) {
#pragma GCC unroll 8
    for (int i = 0; i < kLanes; ++i) {
      if ((i & size) == 0) {
        swap_blocks(square[i], square[i + size], size);
      }
    }
  }
}

/// Writes `count` components, each with a value for every lane, as one row of `count` numbers for
/// each of the first `rows` lanes.
inline void store_rows(const Lanes* components, int count, int rows, double* to) {
  for (int next = 0; next < count; next += kLanes) {
    // The last square overlaps the one before it, where there is one.
    const int first = next + kLanes <= count || count < kLanes ? next : count - kLanes;
    Lanes square[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      square[i] = components[first + i < count ? first + i : 0];
    }
    transpose(square);
    for (int lane = 0; lane < rows; ++lane) {
      double* row = to + lane * count + first;
      if (count >= kLanes) {
        store(square[lane], row);
        continue;
      }
      double numbers[kLanes];
      store(square[lane], numbers);
      for (int i = 0; i < count; ++i) {
        row[i] = numbers[i];
      }
    }
  }
}

}  // namespace thing_kin::THING_KIN_LEVEL
