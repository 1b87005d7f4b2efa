#pragma once

#include "column.hpp"
#include "sincos.hpp"
#include "thing_kin/model/skeleton.hpp"

namespace thing_kin::THING_KIN_LEVEL {

/// frame Tr(offset); most robots' offsets lie along one axis
template <typename C>
[[gnu::always_inline]] inline void shift(const Skeleton::Step& step, Frame<C>& frame) {
  if (step.shifts[0]) {
    frame.origin = frame.origin + step.offset[0] * frame.x;
  }
  if (step.shifts[1]) {
    frame.origin = frame.origin + step.offset[1] * frame.y;
  }
  if (step.shifts[2]) {
    frame.origin = frame.origin + step.offset[2] * frame.z;
  }
}

/// Calls next(u cos + v sin, v cos - u sin): right angles cost nothing.
template <typename C, typename Next>
[[gnu::always_inline]] inline void turn(Turn kind, double cosine, double sine, const C u, const C v,
                                        const Next& next) {
  switch (kind) {
    case Turn::kNone:
      return next(u, v);
    case Turn::kQuarter:
      return next(v, -u);
    case Turn::kMinusQuarter:
      return next(-v, u);
    case Turn::kGeneral:
      return next(cosine * u + sine * v, cosine * v - sine * u);
  }
}

/// Places the first `joints` joints and calls visit(i, frame of joint i after its motion). `motion`
/// has q, and for joints that turn sine and cosine, their constant turn included.
template <typename C, typename Motion, typename Visit>
[[gnu::always_inline]] inline Frame<C> walk(const Skeleton& skeleton, int joints,
                                            const Motion& motion, const Visit& visit) {
  Frame<C> frame;
  read(skeleton.start, frame);
  for (int i = 0; i < joints; ++i) {
    const Skeleton::Step& step = skeleton.step[i];
    if (i > 0) {
      shift(step, frame);
    }
    // y and z by value: tilted, they go on to the joint's motion without a detour through memory.
    const auto move = [&](const C y, const C z) __attribute__((always_inline)) {
      const C x = frame.x;
      frame.z = z;
      if (step.prismatic) {
        frame.origin = frame.origin + motion.q[i] * z;
        turn(
            step.turn, skeleton.cos_turn[i], skeleton.sin_turn[i], x,
            y, [&](const C u, const C v) __attribute__((always_inline)) {
              frame.x = u;
              frame.y = v;
            });
      } else {
        frame.x = motion.cosine[i] * x + motion.sine[i] * y;
        frame.y = motion.cosine[i] * y - motion.sine[i] * x;
      }
    };
    turn(step.tilt, step.cos_tilt, step.sin_tilt, frame.y, frame.z, move);
    visit(i, frame);
  }
  return frame;
}

/// placed * offset
template <typename C>
[[gnu::always_inline]] inline Frame<C> attach(const SkeletonFrame& to, const Frame<C>& placed) {
  const auto along = [&](const double* v) {
    return v[0] * placed.x + v[1] * placed.y + v[2] * placed.z;
  };
  Frame<C> frame = placed;
  frame.origin = placed.origin + along(to.offset + 12);
  if (to.turned) {
    frame.x = along(to.offset);
    frame.y = along(to.offset + 4);
    frame.z = along(to.offset + 8);
  }
  return frame;
}

/// sin and cos of q + turn, from those of q: an angle of many turns keeps all its digits.
inline SinCos add_turn(const SinCos& of_q, const Lanes& sine, const Lanes& cosine) {
  return {of_q.sin * cosine + of_q.cos * sine, of_q.cos * cosine - of_q.sin * sine};
}

/// The motion of one pose; the joints lie along the lanes.
struct Motion {
  double q[kMaxDof];
  alignas(64) double sine[kMaxDof];
  alignas(64) double cosine[kMaxDof];

  Motion(const Skeleton& skeleton, const double* from, int joints) {
    alignas(64) double angle[kMaxDof];
    for (int i = 0; i < joints; ++i) {
      const Skeleton::Step& step = skeleton.step[i];
      q[i] = from[step.index];
      angle[i] = step.prismatic ? 0.0 : q[i];
    }
    for (int i = joints; i % kLanes != 0; ++i) {
      angle[i] = 0.0;
    }
    const bool huge = any_beyond(angle, joints, kLargestAngle);
    for (int i = 0; i < joints; i += kLanes) {
      const SinCos of_q = huge ? sincos_of_any(load(angle + i)) : sincos(load(angle + i));
      const SinCos sum = add_turn(of_q, load(skeleton.sin_turn + i), load(skeleton.cos_turn + i));
      store(sum.sin, sine + i);
      store(sum.cos, cosine + i);
    }
  }
};

/// The motion of kLanes poses, from rows of q. `huge`: some angle may be beyond kLargestAngle.
struct Motions {
  Lanes q[kMaxDof];
  Lanes sine[kMaxDof];
  Lanes cosine[kMaxDof];

  Motions(const Skeleton& skeleton, const double* from, int joints, bool huge) {
    for (int i = 0; i < joints; ++i) {
      const Skeleton::Step& step = skeleton.step[i];
      q[i] = gather(from + step.index, skeleton.joints);
      if (step.prismatic) {
        continue;
      }
      SinCos motion = huge ? sincos_of_any(q[i]) : sincos(q[i]);
      if (step.turn != Turn::kNone) {
        motion = add_turn(motion, splat(skeleton.sin_turn[i]), splat(skeleton.cos_turn[i]));
      }
      sine[i] = motion.sin;
      cosine[i] = motion.cos;
    }
  }
};

/// Calls work(first, rows, motions) for kLanes rows of q after the other, the last few filled up.
template <typename Work>
inline void for_lanes(const Skeleton& skeleton, const double* q, long count, int joints,
                      const Work& work) {
  constexpr long kStretch = 8L * kLanes;  // rows looked over at once for huge angles
  const int n = skeleton.joints;
  bool huge = false;
  for (long first = 0; first < count; first += kLanes) {
    const double* rows = q + first * n;
    const long left = count - first;
    if (first % kStretch == 0) {
      huge = any_beyond(rows, (left < kStretch ? left : kStretch) * n, kLargestAngle);
    }
    if (left >= kLanes) {
      work(first, kLanes, Motions(skeleton, rows, joints, huge));
      continue;
    }
    double filled[kLanes * kMaxDof] = {};
    for (long i = 0; i < left * n; ++i) {
      filled[i] = rows[i];
    }
    work(first, static_cast<int>(left), Motions(skeleton, filled, joints, huge));
  }
}

}  // namespace thing_kin::THING_KIN_LEVEL
