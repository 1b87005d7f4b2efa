#pragma once

#include <string>
#include <vector>

#include "thing_kin/kinematics/link_spheres.hpp"
#include "thing_kin/kinematics/posture.hpp"
#include "thing_kin/model/obstacle.hpp"

namespace thing_kin {

/// What a robot of balls must stay clear of: every sphere of every obstacle (but of Discs, which
/// concern the base's reference point), every pair of spheres of each other, and the base of every
/// Disc. Numbered in this order: obstacle by obstacle, then pairs.
class Clearances {
 public:
  /// Refers to the chain, which must outlive it. Throws InvalidArgument: a Disc without a base, a
  /// bad radius, frame or pair, what is not finite.
  Clearances(const Chain& chain, LinkSpheres spheres, std::vector<Obstacle> obstacles);

  int size() const { return size_; }

  /// m, negative where they overlap.
  double value(const Posture& posture, const double* q, int i) const noexcept;

  /// The same with its gradient by q.
  double gradient(const Posture& posture, const double* q, int i,
                  JointVector& gradient) const noexcept;

  /// H += weight d^2 value/dq^2, exactly.
  void add_hessian(const Posture& posture, const double* q, int i, double weight,
                   SmallMatrix& H) const noexcept;

  /// For messages: "sphere 3 (wrist_1) and obstacle 0", "the base and obstacle 2".
  std::string describe(int i) const;

 private:
  const Chain& chain_;
  LinkSpheres spheres_;
  std::vector<Obstacle> obstacles_;
  int size_ = 0;
};

}  // namespace thing_kin
