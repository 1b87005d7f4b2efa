#pragma once

#include <string>
#include <vector>

#include "thing_kin/core/types.hpp"
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
  /// bad obstacle, radius, frame or pair, what is not finite.
  Clearances(const Chain& chain, const LinkSpheres& spheres, std::vector<Obstacle> obstacles);
  Clearances(Chain&&, const LinkSpheres&, std::vector<Obstacle>) = delete;

  int size() const { return static_cast<int>(rows_.size()); }

  /// m, negative where they overlap.
  double value(const Posture& posture, const double* q, int i) const noexcept;

  /// The same with its gradient by q.
  double gradient(const Posture& posture, const double* q, int i,
                  JointVector& gradient) const noexcept;

  /// H += weight d^2 value/dq^2, exactly. At a center, where no derivative exists: nothing.
  void add_hessian(const Posture& posture, const double* q, int i, double weight,
                   SmallMatrix& H) const noexcept;

  /// For messages: "sphere 3 (forearm) and obstacle 0", "the base and obstacle 2".
  std::string describe(int i) const;

 private:
  /// A ball as the kinematics sees it.
  struct Ball {
    std::string frame;
    int joints;             ///< how many move it
    Eigen::Vector3d point;  ///< from the frame of the last of them, as a posture has it
    double radius;
  };
  /// One clearance: a ball and an obstacle; the base and one; or two balls, of which the joints
  /// between `inner` and `outer` move only the outer one.
  struct Row {
    int outer = -1;     ///< -1: the base
    int inner = -1;     ///< -1: there is an obstacle
    int obstacle = -1;  ///< -1: there are two balls
  };
  /// A distance, by the point that moves.
  struct Measured {
    Eigen::Vector3d point;
    SignedDistance distance;
    int first;  ///< of the joints that count
    int end;
  };

  const Ball& ball(int i) const noexcept { return balls_[static_cast<std::size_t>(i)]; }
  const Obstacle& obstacle(const Row& row) const noexcept {
    return obstacles_[static_cast<std::size_t>(row.obstacle)];
  }
  Eigen::Vector3d center_of(const Ball& ball, const Posture& posture) const noexcept;
  Measured measure(const Posture& posture, const double* q, const Row& row) const noexcept;

  const Chain& chain_;
  std::vector<Ball> balls_;
  std::vector<Obstacle> obstacles_;
  std::vector<Row> rows_;
};

}  // namespace thing_kin
