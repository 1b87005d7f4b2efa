#include "make_skeleton.hpp"

#include <cmath>

#include "thing_kin/core/tolerance.hpp"

namespace thing_kin {

namespace {

/// A rotation about z or x by its cosine and sine: right angles stay exact.
struct Angle {
  double cos = 1.0;
  double sin = 0.0;

  Angle operator*(const Angle& other) const {
    return {cos * other.cos - sin * other.sin, sin * other.cos + cos * other.sin};
  }
  Angle inverse() const { return {cos, -sin}; }
  bool is_identity() const { return cos == 1.0 && sin == 0.0; }
};

/// Rounding next to a right angle goes; the rest is normalized.
Angle exact(double cosine, double sine) {
  if (std::abs(sine) <= kRightAngleTolerance) {
    return {std::copysign(1.0, cosine), 0.0};
  }
  if (std::abs(cosine) <= kRightAngleTolerance) {
    return {0.0, std::copysign(1.0, sine)};
  }
  const double norm = std::hypot(cosine, sine);
  return {cosine / norm, sine / norm};
}

Eigen::Matrix3d about_z(const Angle& angle) {
  Eigen::Matrix3d R;
  R << angle.cos, -angle.sin, 0, angle.sin, angle.cos, 0, 0, 0, 1;
  return R;
}

/// T = Rz(before) Tr(offset) Rx(tilt) Rz(after)
struct Split {
  Angle before;
  Eigen::Vector3d offset;
  Angle tilt;
  Angle after;
};

Split split(const SE3& T) {
  const Eigen::Matrix3d& R = T.rotation;
  Split parts;
  const double slant = std::hypot(R(0, 2), R(1, 2));  // |sin(tilt)|
  parts.tilt = exact(R(2, 2), slant);
  if (parts.tilt.sin == 0.0) {  // parallel axes: the first turn is free, and is none
    parts.after = exact(R(0, 0), -R(0, 1));
    parts.offset = T.translation;
    return parts;
  }
  parts.before = exact(-R(1, 2) / slant, R(0, 2) / slant);
  // Two signs do; the one with the smaller turn more often needs none.
  if (parts.before.cos < 0.0 || (parts.before.cos == 0.0 && parts.before.sin < 0.0)) {
    parts.before = {-parts.before.cos, -parts.before.sin};
    parts.tilt.sin = -parts.tilt.sin;
  }
  const Eigen::Matrix3d back = about_z(parts.before.inverse());
  const Eigen::RowVector3d x_row = back.row(0) * R;
  parts.after = exact(x_row[0], -x_row[1]);
  parts.offset = back * T.translation;
  return parts;
}

Turn kind_of(const Angle& angle) {
  if (angle.is_identity()) {
    return Turn::kNone;
  }
  if (angle.cos == 0.0) {
    return angle.sin > 0.0 ? Turn::kQuarter : Turn::kMinusQuarter;
  }
  return Turn::kGeneral;
}

void write_columns(const SE3& T, double* columns) {
  for (int col = 0; col < 3; ++col) {
    Eigen::Map<Eigen::Vector3d>(columns + 4 * col) = T.rotation.col(col);
  }
  Eigen::Map<Eigen::Vector3d>(columns + 12) = T.translation;
}

}  // namespace

Skeleton make_skeleton(std::span<const Chain::Joint> joints) {
  Skeleton skeleton;
  skeleton.joints = static_cast<int>(joints.size());
  write_columns(joints[0].fixed, skeleton.start);
  Angle after;  // what the last split left for the joint behind it
  for (std::size_t i = 0; i < joints.size(); ++i) {
    Skeleton::Step& step = skeleton.step[i];
    step.index = joints[i].index;
    step.prismatic = joints[i].type == JointType::kPrismatic;
    if (i > 0) {
      const Split parts = split(joints[i].fixed);
      Eigen::Map<Eigen::Vector3d>{step.offset} = parts.offset;
      for (int axis = 0; axis < 3; ++axis) {
        step.shifts[axis] = parts.offset[axis] != 0.0;
      }
      step.cos_tilt = parts.tilt.cos;
      step.sin_tilt = parts.tilt.sin;
      step.tilt = kind_of(parts.tilt);
      after = parts.after;
    }
    const bool last = i + 1 == joints.size();
    const Angle turn = after * (last ? Angle{} : split(joints[i + 1].fixed).before);
    step.turn = kind_of(turn);
    skeleton.cos_turn[i] = turn.cos;
    skeleton.sin_turn[i] = turn.sin;
  }
  return skeleton;
}

SkeletonFrame make_skeleton_frame(std::span<const Chain::Joint> joints, const Chain::Frame& frame) {
  SkeletonFrame result;
  result.joints = frame.joints;
  SE3 offset = frame.offset;
  const auto next = static_cast<std::size_t>(frame.joints);
  if (frame.joints > 0 && next < joints.size()) {
    // The turn that joint `next` moved here from its own transform is not the frame's.
    SE3 back;
    back.rotation = about_z(split(joints[next].fixed).before.inverse());
    offset = back * offset;
  }
  result.turned = !offset.rotation.isIdentity(0.0);
  write_columns(offset, result.offset);
  return result;
}

}  // namespace thing_kin
