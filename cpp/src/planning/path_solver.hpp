#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/linalg/stagewise_qp.hpp"
#include "thing_kin/planning/path_problem.hpp"

namespace thing_kin {

/// Sequential quadratic programming over a window of waypoints. Every iterate is on its poses: a
/// step is taken in the null spaces of their Jacobians and then brought back by Newton's method,
/// so that what is left is a problem in n - 6 unknowns a waypoint, block tridiagonal.
///
/// Nothing allocates after the constructor while `capacity` and the room for points within
/// segments are not exceeded.
class PathSolver {
 public:
  enum class Outcome : std::uint8_t {
    kStepped,     ///< go on
    kConverged,   ///< stationary and feasible
    kStationary,  ///< stationary, but constraints are violated at the largest penalty
  };

  /// What is minimized, and by how much the constraints are missed.
  struct Merit {
    double objective = 0.0;
    double violation = 0.0;  ///< sum, m and rad
    double worst = 0.0;      ///< largest
  };

  /// How far inside their bounds constraints are kept, so that what the solver calls feasible is
  /// (m, rad), and how well it keeps that.
  static constexpr double kMargin = 1e-7;
  static constexpr double kFeasible = 3e-8;

  PathSolver(const PathProblem& problem, int capacity);

  const PathProblem& problem() const { return problem_; }
  int count() const { return static_cast<int>(goals_.size()); }

  /// Takes over goals; configurations are to be given afterwards, then begin().
  void set_goals(const std::vector<PathGoal>& goals);
  double* q(int k) { return q_.data() + k * n_; }
  const double* q(int k) const { return q_.data() + k * n_; }
  const std::vector<PathGoal>& goals() const { return goals_; }

  /// The window moves on by one: waypoint 0 is dropped, `goal` enters at the end with
  /// configuration q. Multipliers move along.
  void drop_first() noexcept;
  void append(const PathGoal& goal, const double* from) noexcept;

  /// Waypoint 0 stands still; else the way to it from `from` counts like a step, if there is one.
  void hold_first(bool hold) { fixed_ = hold ? 1 : 0; }
  void come_from(const double* from);

  /// Penalty of a unit of violation to begin with.
  void set_penalty(double rho) { rho_ = rho; }

  /// Forgets multipliers and step sizes.
  void forget() noexcept;

  /// A further point of segment k, t in (0, 1), at which clearance i must hold.
  void watch(int k, int i, double t);

  /// Brings waypoint k onto its pose; false if Newton's method does not get there.
  bool settle(int k) noexcept { return retract(goals_[static_cast<std::size_t>(k)], q(k)); }
  bool retract(const PathGoal& goal, double* q) const noexcept;

  /// Evaluates the configurations as they stand.
  Merit begin() noexcept;

  /// One iteration.
  Outcome iterate() noexcept;

  const Merit& merit() const { return merit_; }

  /// Largest violation of waypoint 1's constraints and of the way to it.
  double violation_of_first() noexcept;
  double penalty() const { return rho_; }

 private:
  enum class Kind : std::uint8_t { kLinear, kStep, kBase, kClearance, kInner, kWatched };
  struct Ref {  // what a row of the quadratic program is
    Kind kind;
    int k;  // waypoint or segment
    int i;  // joint, clearance or watched point
    double sign;
  };
  struct Watched {
    int k, i;
    double t, multiplier;
  };
  struct Inner {  // a point within a segment and what the clearance is there
    double t = -1.0;
    double value = 0.0;
  };

  struct PointRow {  // a clearance with a multiplier: at a waypoint (t < 0) or within a segment
    int k, i;
    double t, z;
  };

  Merit evaluate(const double* q) noexcept;
  void evaluate_waypoint(int k, const double* q, Merit& merit) noexcept;
  void evaluate_segment(int k, const double* q, Merit& merit) noexcept;
  Inner inner_minimum(int k, const double* from, int i, double d_from, double d_to) const noexcept;
  double step_bound(int j) const noexcept {
    return problem_.max_joint_step[j] - std::min(kMargin, 0.5 * problem_.max_joint_step[j]);
  }
  double base_slack(int k, const double* at, double* gradient) const noexcept;

  void linearize() noexcept;
  void linearize_waypoint(int k) noexcept;
  void add_rows() noexcept;
  void add_waypoint_rows(int k) noexcept;
  void add_segment_rows(int k) noexcept;
  void add_point_row(Kind kind, int k, int i, double t, double z) noexcept;
  void add_linear(int k, int j, double sign, double slack) noexcept;
  void add_objective() noexcept;
  void add_curvature(bool convex) noexcept;
  void add_point_curvature(const PointRow& point, bool convex) noexcept;
  void project(int k, const SmallMatrix& H, double* out, bool convex) const noexcept;
  void keep_multipliers() noexcept;
  bool try_steps(double decrease, double longest) noexcept;
  bool move_to_trial(double alpha) noexcept;
  double solve_model() noexcept;

  int stage(int k) const { return k - fixed_; }
  const double* basis(int k) const { return Z_.data() + k * n_ * m_; }

  const PathProblem& problem_;
  int n_, m_, clearances_;
  std::vector<PathGoal> goals_;
  int fixed_ = 0;
  bool has_origin_ = false;
  JointVector origin_;
  JointVector square_weights_;

  std::vector<double> q_, trial_, dq_, Z_;
  std::vector<Jacobian> J_;
  std::vector<Posture> postures_;  // of what was evaluated last
  std::vector<double> values_;     // clearances at each waypoint of the iterate
  std::vector<double> trial_values_;
  std::vector<double> gradient_, dexterity_gradient_, dexterity_hessian_;
  std::vector<double> lagrangian_;            // gradient of the Lagrangian by q, n a waypoint
  std::vector<double> linear_multiplier_;     // n a waypoint: gradients of linear rows, weighed
  std::vector<double> base_multiplier_;       // one a waypoint
  std::vector<double> clearance_multiplier_;  // C a waypoint
  std::vector<double> inner_multiplier_;      // C a segment
  std::vector<Watched> watched_;
  std::vector<Ref> refs_;
  std::vector<double> curvature_;  // m x m a waypoint
  StagewiseQp qp_;
  std::vector<PointRow> points_;

  Merit merit_;
  double rho_ = 1.0;
  double damping_ = 0.0;
  double radius_ = 0.5;
  double last_decrease_ = 1.0;
  bool all_rows_ = false;  ///< also those that a step can hardly reach
};

}  // namespace thing_kin
