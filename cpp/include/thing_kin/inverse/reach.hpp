#pragma once

#include "thing_kin/inverse/joint_box.hpp"

namespace thing_kin {

/// How far a frame can be from where the chain begins: an upper bound from the lengths of its
/// links, and what sliding joints at its root (a mobile base) add to it.
class Reach {
 public:
  Reach(const Chain& chain, int frame) noexcept;

  /// Least distance by which `point` is certainly out of reach, m; 0 if it may be within.
  double beyond(const JointBox& box, const Eigen::Vector3d& point) const noexcept;

  /// Moves the sliding joints at the root along `way`, m, of the frame, but so that `rest` of it
  /// is left; they stay in the box. What is left of the way is written back.
  void drive(const JointBox& box, double rest, Eigen::Vector3d& way, double* q) const noexcept;

  bool has_slides() const { return count_ > 0; }

  /// Bound on the distance from the end of the sliding joints to the frame, m; may be infinite.
  double radius() const { return radius_; }

  /// The length of all links, m.
  double length() const { return length_; }

 private:
  struct Slide {
    Eigen::Vector3d axis;
    Eigen::Index index;
  };

  std::array<Slide, 3> slides_;  // mutually orthogonal
  std::size_t count_ = 0;
  Eigen::Vector3d origin_;  // of the first joint that is no slide, with the slides at zero
  double radius_ = 0.0;
  double length_ = 0.0;
};

}  // namespace thing_kin
