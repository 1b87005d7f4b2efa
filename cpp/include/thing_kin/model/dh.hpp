#pragma once

#include <optional>
#include <string>
#include <vector>

#include "thing_kin/lie/se3.hpp"
#include "thing_kin/model/segment.hpp"

namespace thing_kin {

/// One standard (distal) Denavit-Hartenberg row, [M17] (3.7): Rz(theta) Tz(d) Tx(a) Rx(alpha).
/// A revolute joint's variable adds to theta, a prismatic one's to d; a fixed row has none.
struct DhRow {
  double d = 0.0;      ///< m
  double theta = 0.0;  ///< rad
  double a = 0.0;      ///< m
  double alpha = 0.0;  ///< rad
  JointType joint = JointType::kFixed;
  JointLimits limits;
  std::string name;   ///< of the joint; empty: q0, q1, ...
  std::string frame;  ///< of the frame after the row; empty: frame1, frame2, ..., tool
};

/// Throws InvalidArgument unless the row is finite and its limits are in order.
void check(const DhRow& row);

/// [M17] (3.7). Angles within rounding of a multiple of pi/2 give exact zeros and ones.
SE3 dh_transform(double d, double theta, double a, double alpha);

/// The row as a segment: the joint moves about the z axis of the frame before the row.
Segment to_segment(const DhRow& row);

}  // namespace thing_kin
