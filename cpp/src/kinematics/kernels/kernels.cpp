// Compiled once for each instruction set: cpp/CMakeLists.txt defines THING_KIN_LEVEL (a namespace)
// and THING_KIN_LANES.

#include "kernels.hpp"

#include "arc_tangent.hpp"
#include "damped.hpp"
#include "dexterity.hpp"
#include "quaternion.hpp"
#include "walk.hpp"

namespace thing_kin::THING_KIN_LEVEL {

namespace {

void place(const Skeleton& skeleton, const double* q, int joints, double* columns) noexcept {
  const Motion motion(skeleton, q, joints);
  walk<Column>(skeleton, joints, motion,
               [&](int i, const Frame<Column>& frame) { write(frame, columns + 16 * i); });
}

void pose(const Skeleton& skeleton, const SkeletonFrame& frame, const double* q,
          double* columns) noexcept {
  if (frame.joints == 0) {
    for (int i = 0; i < 16; ++i) {
      columns[i] = frame.offset[i];
    }
    return;
  }
  const Motion motion(skeleton, q, frame.joints);
  const auto placed =
      walk<Column>(skeleton, frame.joints, motion, [](int, const Frame<Column>&) {});
  write(attach(frame, placed), columns);
}

// Pose of a frame whose joints are placed already; `last` is that of joint frame.joints - 1.
template <typename C>
[[gnu::always_inline]] inline Frame<C> end_of(const SkeletonFrame& frame, const Frame<C>& last) {
  if (frame.joints > 0) {
    return attach(frame, last);
  }
  Frame<C> end;
  read(frame.offset, end);
  return end;
}

// v in the axes of the frame whose axes make up the rows.
Column in_axes(const Column rows[3], const Column& v) {
  return v[0] * rows[0] + v[1] * rows[1] + v[2] * rows[2];
}

Columns in_axes(const Frame<Columns>& frame, const Columns& v) {
  const auto dot = [&](const Columns& a) { return a.x * v.x + a.y * v.y + a.z * v.z; };
  return {dot(frame.x), dot(frame.y), dot(frame.z)};
}

void jacobian(const Skeleton& skeleton, const SkeletonFrame& frame, const double* placed,
              ReferenceFrame reference, double* J) noexcept {
  Frame<Column> end{};
  if (frame.joints > 0) {
    read(placed + 16 * (frame.joints - 1), end);
  }
  end = end_of(frame, end);
  const Column point = reference == ReferenceFrame::kWorld ? Column{} : end.origin;
  Column rows[3] = {};
  if (reference == ReferenceFrame::kBody) {
    for (int i = 0; i < 3; ++i) {
      const double row[] = {end.x[i], end.y[i], end.z[i], 0.0};
      read(row, rows[i]);
    }
  }
  for (int i = 0; i < skeleton.joints; ++i) {
    const Skeleton::Step& step = skeleton.step[i];
    Column v{};
    Column w{};
    if (i < frame.joints) {
      Column z;
      read(placed + 16 * i + 8, z);
      z = reference == ReferenceFrame::kBody ? in_axes(rows, z) : z;
      if (step.prismatic) {
        v = z;
      } else {
        Column origin;
        read(placed + 16 * i + 12, origin);
        Column arm = point - origin;
        arm = reference == ReferenceFrame::kBody ? in_axes(rows, arm) : arm;
        v = cross(z, arm);
        w = z;
      }
    }
    double* to = J + 6 * step.index;
    write(v, to);  // its pad is overwritten next
    to[3] = w[0];
    to[4] = w[1];
    to[5] = w[2];
  }
}

int put_matrix(const Frame<Columns>& T, Lanes* to) {
  const Lanes zero = splat(0.0);
  const Lanes rows[] = {T.x.x, T.y.x, T.z.x, T.origin.x,  //
                        T.x.y, T.y.y, T.z.y, T.origin.y,  //
                        T.x.z, T.y.z, T.z.z, T.origin.z,  //
                        zero,  zero,  zero,  splat(1.0)};
  for (int i = 0; i < 16; ++i) {
    to[i] = rows[i];
  }
  return 16;
}

int put_position_quaternion(const Frame<Columns>& T, Lanes* to) {
  const Quaternion q = quaternion_of(T, Kernels::kHalfTurnTolerance);
  const Lanes row[] = {T.origin.x, T.origin.y, T.origin.z, q.w, q.x, q.y, q.z};
  for (int i = 0; i < 7; ++i) {
    to[i] = row[i];
  }
  return 7;
}

void poses(const Skeleton& skeleton, const SkeletonFrame& frame, const double* q, long count,
           PoseFormat format, double* out) noexcept {
  for_lanes(skeleton, q, count, frame.joints, [&](long first, int rows, const Motions& motions) {
    const auto placed =
        walk<Columns>(skeleton, frame.joints, motions, [](int, const Frame<Columns>&) {});
    const Frame<Columns> T = end_of(frame, placed);
    Lanes components[16];
    const int size = format == PoseFormat::kMatrix ? put_matrix(T, components)
                                                   : put_position_quaternion(T, components);
    store_rows(components, size, rows, out + first * size);
  });
}

// (6, joints) in row order, with zeros for the joints beyond the frame.
void put_jacobian(const Skeleton& skeleton, int moving, const Columns* axis, const Columns* origin,
                  const Frame<Columns>& end, ReferenceFrame reference, Lanes* to) {
  const Lanes zero = splat(0.0);
  const Columns none{zero, zero, zero};
  const Columns point = reference == ReferenceFrame::kWorld ? none : end.origin;
  const int n = skeleton.joints;
  for (int i = 0; i < n; ++i) {
    const Skeleton::Step& step = skeleton.step[i];
    Columns v = none;
    Columns w = none;
    if (i < moving && step.prismatic) {
      v = reference == ReferenceFrame::kBody ? in_axes(end, axis[i]) : axis[i];
    } else if (i < moving) {
      v = cross(axis[i], point - origin[i]);
      v = reference == ReferenceFrame::kBody ? in_axes(end, v) : v;
      w = reference == ReferenceFrame::kBody ? in_axes(end, axis[i]) : axis[i];
    }
    const Lanes column[] = {v.x, v.y, v.z, w.x, w.y, w.z};
    for (int row = 0; row < 6; ++row) {
      to[row * n + step.index] = column[row];
    }
  }
}

void jacobians(const Skeleton& skeleton, const SkeletonFrame& frame, const double* q, long count,
               ReferenceFrame reference, double* T, double* J) noexcept {
  const int n = skeleton.joints;
  for_lanes(skeleton, q, count, frame.joints, [&](long first, int rows, const Motions& motions) {
    Columns axis[kMaxDof];
    Columns origin[kMaxDof];
    const auto placed =
        walk<Columns>(skeleton, frame.joints, motions, [&](int i, const Frame<Columns>& at) {
          axis[i] = at.z;
          origin[i] = at.origin;
        });
    const Frame<Columns> end = end_of(frame, placed);
    Lanes components[6 * kMaxDof];
    if (T != nullptr) {
      store_rows(components, put_matrix(end, components), rows, T + 16 * first);
    }
    put_jacobian(skeleton, frame.joints, axis, origin, end, reference, components);
    store_rows(components, 6 * n, rows, J + 6 * n * first);
  });
}

void damped_inverse(const double* J, const double* mobility, int n, const double* factors,
                    double lambda, const double* e, double* dq) noexcept {
  Matrix3 linear;
  Matrix3 angular;
  read(factors, linear);
  read(factors + 12, angular);
  double A[6][6];
  normal_matrix(J, mobility, n, linear, angular, lambda, A);
  double y[6] = {e[0], e[1], e[2], e[3], e[4], e[5]};
  solve_symmetric(A, lambda, y);
  double f[6];  // what y is before the factors
  for (int k = 0; k < 3; ++k) {
    const double* L = factors + 4 * k;
    const double* R = L + 12;
    f[k] = L[0] * y[0] + L[1] * y[1] + L[2] * y[2];
    f[3 + k] = R[0] * y[3] + R[1] * y[4] + R[2] * y[5];
  }
  for (int j = 0; j < n; ++j) {
    const double* c = J + 6 * j;
    dq[j] = mobility[j] *
            ((c[0] * f[0] + c[1] * f[1] + c[2] * f[2]) + (c[3] * f[3] + c[4] * f[4] + c[5] * f[5]));
  }
}

void dexterity(const DexterityArguments& arguments, double* values, double* gradient,
               double* hessian) noexcept {
  log_dexterity(arguments, values, gradient, hessian);
}

void dexterity_along(const DexterityArguments& arguments, const double* Z, int width,
                     double* values, double* gradient, double* hessian) noexcept {
  log_dexterity_along(arguments, Z, width, values, gradient, hessian);
}

void spectrum(const DexterityArguments& arguments, double* values) noexcept {
  dexterity_spectrum(arguments, values);
}

void bounds(const DexterityArguments& arguments, double* values) noexcept {
  dexterity_bounds(arguments, values);
}

void arc_tangents(const double* sine, const double* cosine, long count, double* angle) noexcept {
  long i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    store(arc_tangent(load(sine + i), load(cosine + i)), angle + i);
  }
  if (i < count) {
    double filled[3][kLanes] = {};
    for (long k = i; k < count; ++k) {
      filled[0][k - i] = sine[k];
      filled[1][k - i] = cosine[k];
    }
    store(arc_tangent(load(filled[0]), load(filled[1])), filled[2]);
    for (long k = i; k < count; ++k) {
      angle[k] = filled[2][k - i];
    }
  }
}

}  // namespace

extern const Kernels kKernels;
const Kernels kKernels{place,     pose,           jacobian,    poses,
                       jacobians, damped_inverse, dexterity,   dexterity_along,
                       spectrum,  bounds,         arc_tangents};

}  // namespace thing_kin::THING_KIN_LEVEL
