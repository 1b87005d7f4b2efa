#pragma once

// What ClosedFormIk keeps of an arm: constants of its geometry, as the subproblems read them.

#include <array>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "thing_kin/lie/se3.hpp"

namespace thing_kin::closed_form {

/// An angle by its cosine and sine, which solutions stay until the end; products add angles.
struct Angle {
  double cos = 1.0;
  double sin = 0.0;

  Angle operator*(const Angle& other) const noexcept {
    return {cos * other.cos - sin * other.sin, sin * other.cos + cos * other.sin};
  }
  Angle inverse() const noexcept { return {cos, -sin}; }
};

/// Joints 1-6 at q = 0, in the frame of the arm's root: the lines about which they turn, and the
/// pose of the frame that is to reach the target.
struct Axes {
  std::array<Eigen::Vector3d, 6> direction;
  std::array<Eigen::Vector3d, 6> point;
  SE3 tool;
};

/// angle_j = sign_j q_j + offset_j turns a joint's q into the angle of the canonical frames below.
struct JointAngle {
  double sign = 1.0;
  double offset = 0.0;  ///< rad
};

/// Joints x, y and theta of a planar base.
struct PlanarBase {
  Eigen::Vector3d along_x{1, 0, 0}, along_y{0, 1, 0};
  SE3 turn;  ///< frame of the joint theta at x = y = 0

  SE3 pose(const double* base) const noexcept {
    const double c = std::cos(base[2]);
    const double s = std::sin(base[2]);
    Eigen::Matrix3d Rz;
    Rz << c, -s, 0, s, c, 0, 0, 0, 1;
    return {turn.rotation * Rz, turn.translation + base[0] * along_x + base[1] * along_y};
  }
};

/// Joints 4-6 as directions. Frame 4 has z along axis 4; the canonical tool has z along axis 6 and
/// axis 5 in its xz plane, at alpha from axis 6 and at beta from axis 4.
struct Wrist {
  double cos_alpha = 0.0, sin_alpha = 1.0, alpha = 0.0;
  double cos_beta = 0.0, sin_beta = 1.0, beta = 0.0;
  bool right_angles = true;
  Angle from_axis5;  ///< less the angle of axis 5 about axis 4 at home, in frame 4's xy plane
};

/// Axes 2, 3 and 4 parallel. The root's canonical frame has z along axis 1 and the direction h of
/// the parallel axes in its xz plane; frame 4 is that turned so that z is h: columns (-hz, 0, hx),
/// (0, -1, 0), (hx, 0, hz). Plane coordinates are its x and y.
struct ParallelArm {
  Wrist wrist;
  double hx = 1.0, hz = 0.0;
  double along = 0.0;             ///< from axis 1's origin to axis 5, along h, m
  Eigen::Vector2d start{0, 0};    ///< axis 2 in the plane
  Eigen::Vector2d forearm{0, 0};  ///< what hangs on joint 4: constant, cos, sin of angle 5
  Eigen::Vector2d forearm_cos{0, 0}, forearm_sin{0, 0};
  double upper = 0.0, lower = 0.0;  ///< lengths of the links between the parallel axes, m
  double offset56 = 0.0;            ///< of axis 6 from axis 5, m; not zero: a quartic
  bool parallel56 = false;          ///< axes 5 and 6 parallel, offset56 apart along x
};

/// One equation in two angles: constant + squared |p|^2 + height p_z + u . (x, y) = v . (c3, s3),
/// where (x, y) is p turned back by joint 1.
struct SphericalRow {
  double constant = 0.0, squared = 0.0, height = 0.0;
  Eigen::Vector2d u{0, 0}, v{0, 0};
};

/// Axes 4, 5 and 6 meet in a point p; frame i has z along axis i.
struct SphericalArm {
  enum class Order : std::uint8_t { kFirst, kThird, kQuartic };

  Wrist wrist;
  Order order = Order::kFirst;       ///< which joint row 0 gives by itself
  std::array<SphericalRow, 2> rows;  ///< row 1 gives the other joint
  Eigen::Matrix3d R12, R23, R34;     ///< between neighboring frames at home
  Eigen::Vector3d p12, p23;          ///< between points on axes, in frames 1 and 2, m
  double r34 = 0.0;                  ///< of p from axis 3, along frame 3's x, m
};

}  // namespace thing_kin::closed_form
