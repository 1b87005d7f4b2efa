#pragma once

#include <cstddef>

#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/kinematics/pose_format.hpp"

namespace thing_kin {

inline int numbers_of(PoseFormat format) { return format == PoseFormat::kMatrix ? 16 : 7; }

/// Many configurations at once: `q` and the results are rows one after the other, in C order.
/// Several poses are computed side by side in the lanes of one instruction, and large batches on
/// several threads; every row's result is the same for any number of rows and threads.
struct JointBatch {
  const double* q = nullptr;
  std::size_t count = 0;
  int threads = 0;  ///< 0: as many as pay
};

/// Poses of a frame; `out` has numbers_of(format) a row.
void forward_kinematics(const Chain& chain, const JointBatch& batch, int frame, PoseFormat format,
                        double* out);

/// Geometric Jacobians of a point, (6, n) row-major a row.
void geometric_jacobian(const Chain& chain, const JointBatch& batch, const MovingPoint& of,
                        ReferenceFrame reference, double* J);

/// Poses, (4, 4), and Jacobians of a frame.
void forward_kinematics_and_jacobian(const Chain& chain, const JointBatch& batch, int frame,
                                     ReferenceFrame reference, double* T, double* J);

}  // namespace thing_kin
