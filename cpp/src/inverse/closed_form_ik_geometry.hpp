#pragma once

// From the lines of six joints to the constants that the closed forms read.

#include <array>
#include <optional>

#include "thing_kin/inverse/closed_form_arm.hpp"

namespace thing_kin::closed_form {

/// An arm in canonical form, and how to get there.
template <typename Constants>
struct Canonical {
  Constants constants;
  SE3 root;  ///< canonical frame of the root, in the frame of the axes
  SE3 hand;  ///< the canonical tool in the frame that is to reach the target
  std::array<JointAngle, 6> angle;
};

/// What keeps an arm from a form: how far it is from it.
struct Misfit {
  double angle = 0.0;       ///< rad between axes that should be parallel
  double distance = 0.0;    ///< m between axes that should meet
  bool degenerate = false;  ///< of the form, but it can't move in all directions anywhere
};

/// Sum of the distances from axis to axis and on to the tool, m.
double length_of(const Axes& axes);

/// The same arm from its tool to its root: joint 1 is what joint 6 was.
Axes reversed(const Axes& axes);

std::optional<Canonical<ParallelArm>> as_parallel(const Axes& axes, double tolerance,
                                                  Misfit& misfit);
std::optional<Canonical<SphericalArm>> as_spherical(const Axes& axes, double tolerance,
                                                    Misfit& misfit);

/// Where two lines come closest: a point on each, and whether they are parallel within `tolerance`;
/// if so the first line's own point and its foot on the second.
struct CommonNormal {
  Eigen::Vector3d on_first, on_second;
  double sine = 0.0;  ///< of the angle between them
  double distance = 0.0;
};

CommonNormal common_normal(const Axes& axes, std::size_t first, std::size_t second,
                           double tolerance);

/// A frame with this z, and x as near to `x` as may be, or anywhere if that is along z.
Eigen::Matrix3d frame_along(const Eigen::Vector3d& z, const Eigen::Vector3d& x);

/// Constants of the wrist and the offset of joint 5's angle, from frame 4 and the canonical tool at
/// home. False if neighboring axes are in line.
bool make_wrist(const Eigen::Matrix3d& frame4, const Eigen::Vector3d& axis5,
                const Eigen::Matrix3d& hand, double tolerance, Wrist& wrist, JointAngle& angle5);

}  // namespace thing_kin::closed_form
