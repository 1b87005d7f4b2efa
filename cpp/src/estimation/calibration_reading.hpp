#pragma once

#include <cmath>

#include "thing_kin/estimation/calibration_parameters.hpp"

namespace thing_kin {

/// Whether it changes what a joint's reading means.
inline bool is_reading(CalibrationPart part) {
  return part == CalibrationPart::kOffset || part == CalibrationPart::kScale ||
         part == CalibrationPart::kSag;
}

/// T <- T joint(reading): a turn about z, or a slide along it.
inline void move_joint(JointType type, double reading, SE3& T) {
  if (is_rotary(type)) {
    const double c = std::cos(reading);
    const double s = std::sin(reading);
    const Eigen::Vector3d x = T.rotation.col(0);
    const Eigen::Vector3d y = T.rotation.col(1);
    T.rotation.col(0) = c * x + s * y;
    T.rotation.col(1) = c * y - s * x;
  } else if (type == JointType::kPrismatic) {
    T.translation += reading * T.rotation.col(2);
  }
}

}  // namespace thing_kin
