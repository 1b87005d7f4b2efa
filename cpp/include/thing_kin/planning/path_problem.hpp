#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "thing_kin/kinematics/clearance.hpp"
#include "thing_kin/lie/se3.hpp"
#include "thing_kin/model/chain.hpp"

namespace thing_kin {

inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// What is asked at one waypoint.
struct PathGoal {
  SE3 pose;                                        ///< of the frame, in the root
  Eigen::Vector3d base = Eigen::Vector3d::Zero();  ///< x, y (m) and theta (rad) of the base path
  double heading_lower = -kUnlimited;              ///< rad, of theta as it stands in q
  double heading_upper = kUnlimited;
};

/// What is the same at all waypoints. Refers to the chain, which must outlive it.
class PathProblem {
 public:
  /// Throws InvalidArgument: fewer than six joints, an unknown frame, a Disc without a base.
  PathProblem(const Chain& chain, int frame, std::vector<Obstacle> obstacles, LinkSpheres spheres);
  PathProblem(Chain&&, int, std::vector<Obstacle>, LinkSpheres) = delete;

  const Chain& chain() const { return *chain_; }
  int frame() const { return frame_; }
  int dof() const { return chain_->dof(); }
  int freedom() const { return chain_->dof() - 6; }
  const std::vector<Obstacle>& obstacles() const { return obstacles_; }
  const LinkSpheres& spheres() const { return spheres_; }
  const Clearances& clearances() const { return clearances_; }

  /// On the straight line in joint space from q to q + dq the distance of clearance i curves
  /// downwards by at most this: d(t) + bound t^2/2 is convex for t in [0, 1], m.
  double curvature_bound(int i, const double* q, const double* dq) const noexcept;

  /// How far what clearance i is about moves from q to q + dq at most, m.
  double motion_bound(int i, const double* q, const double* dq) const noexcept;

  bool has_base_path = false;
  bool has_base_heading = false;  ///< the base path has a theta to be near at
  double base_radius = kUnlimited;
  JointVector max_joint_step;  ///< (n), > 0, may be infinite
  JointVector joint_weights;   ///< (n), > 0: W of the joints' steps
  JointVector column_weights;  ///< (n), >= 0: whose dexterity
  double dexterity_weight = 0.0;

 private:
  // What a clearance is about: one sphere, two, or the base (-1).
  struct Subject {
    int first = -1;
    int second = -1;
  };
  // A sphere's center, in the moved frame of the last of so many joints.
  struct Center {
    int joints;
    Eigen::Vector3d point;
  };
  void add_levers(const Subject& subject);
  double slides(const double* q, const double* dq) const noexcept;

  const Chain* chain_;
  int frame_;
  std::vector<Obstacle> obstacles_;
  LinkSpheres spheres_;
  Clearances clearances_;
  std::vector<Center> centers_;
  std::vector<Subject> subjects_;
  std::vector<double> levers_;  // a joint and a clearance
};

}  // namespace thing_kin
