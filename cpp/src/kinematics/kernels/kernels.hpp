#pragma once

#include "thing_kin/kinematics/pose_format.hpp"
#include "thing_kin/kinematics/reference_frame.hpp"
#include "thing_kin/model/skeleton.hpp"

namespace thing_kin {

/// What log_dexterity.hpp computes from: J (6, n) in column order, the joints in chain order of
/// which those before `first` change nothing, factors of the columns or null.
struct DexterityArguments {
  const double* J;
  const int* order;
  int count;
  int first;
  const double* weights;
  double condition_number;  ///< how much log kappa counts
  double manipulability;    ///< how much -log M counts
  int stride;               ///< of the Hessian

  /// The rank is lost below this fraction of the largest eigenvalue.
  static constexpr double kSingular = 6 * 0x1p-52;

  /// Two eigenvalues nearer than this fraction count as this far apart.
  static constexpr double kLeastGap = 1e-8;
};

/// The loops of forward kinematics and Jacobian, compiled for one instruction set. Numbers only:
/// see lanes.hpp. Columns are x, y, z, origin of a frame, each padded to four numbers.
struct Kernels {
  /// As core/tolerance.hpp has it, which dispatch.cpp checks: that header has functions.
  static constexpr double kHalfTurnTolerance = 0x1p-49;

  /// Frames of the first `joints` joints after their motion: 16 numbers each.
  void (*place)(const Skeleton& skeleton, const double* q, int joints, double* columns) noexcept;

  /// Pose of a frame: 16 numbers.
  void (*pose)(const Skeleton& skeleton, const SkeletonFrame& frame, const double* q,
               double* columns) noexcept;

  /// Jacobian of a frame of placed joints, (6, joints) in column order.
  void (*jacobian)(const Skeleton& skeleton, const SkeletonFrame& frame, const double* placed,
                   ReferenceFrame reference, double* J) noexcept;

  /// Poses for `count` rows of q: 16 numbers each, row-major, or 7.
  void (*poses)(const Skeleton& skeleton, const SkeletonFrame& frame, const double* q, long count,
                PoseFormat format, double* out) noexcept;

  /// Jacobians for `count` rows of q, (6, joints) each in row order; row-major poses too unless T
  /// is null.
  void (*jacobians)(const Skeleton& skeleton, const SkeletonFrame& frame, const double* q,
                    long count, ReferenceFrame reference, double* T, double* J) noexcept;

  /// dq of damped_inverse.hpp; J (6, n) and `factors`, two (3, 3), in column order, those of the
  /// factors padded to four.
  void (*damped_inverse)(const double* J, const double* mobility, int n, const double* factors,
                         double lambda, const double* e, double* dq) noexcept;

  /// values: the largest and the smallest eigenvalue of J W J^T, and the product of all six.
  /// gradient, hessian: only the entries of joints from `first` on; not touched where the rank is
  /// lost.
  void (*log_dexterity)(const DexterityArguments& arguments, double* values, double* gradient,
                        double* hessian) noexcept;

  /// The same, but the Hessian in the directions of Z only: Z^T H Z (width, width), for Z
  /// (n, width) in column order with the stride of the arguments.
  void (*log_dexterity_along)(const DexterityArguments& arguments, const double* Z, int width,
                              double* values, double* gradient, double* hessian) noexcept;

  /// The values alone.
  void (*dexterity_spectrum)(const DexterityArguments& arguments, double* values) noexcept;

  /// The values alone, with a bound from above and one from below for the largest and the smallest:
  /// at most the factor 6^(1/8) off.
  void (*dexterity_bounds)(const DexterityArguments& arguments, double* values) noexcept;

  /// Angles of `count` pairs.
  void (*arc_tangents)(const double* sine, const double* cosine, long count,
                       double* angle) noexcept;
};

/// Those of the level in use (core/simd.hpp).
const Kernels& kernels() noexcept;

}  // namespace thing_kin
