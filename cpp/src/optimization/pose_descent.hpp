#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "pose_program.hpp"
#include "thing_kin/inverse/ik_descent.hpp"
#include "thing_kin/kinematics/log_dexterity.hpp"
#include "thing_kin/linalg/row_qr.hpp"
#include "thing_kin/optimization/pose_plan.hpp"

namespace thing_kin {

/// The most iterations that bring the hand to the target from where it is.
inline constexpr int kMostArrivals = 60;

/// A configuration with the hand at the target, but for a small miss, and what is known of it.
struct PosePoint {
  JointVector q;
  Vector6 miss;  // the way to the target, [linear, angular], axes of the world
  Posture posture;
  Jacobian J;
  RowQr rows;              // of J
  SmallMatrix Z;           // its null space
  LogDexterity objective;  // its second derivative along Z
  Eigen::VectorXd slack;   // of the inequalities: the base's disc, if there is one; the clearances
  double violation = 0.0;  // the sum of what they fall short of zero
};

/// One descent on the configurations that have the hand at the target.
class PoseDescent {
 public:
  PoseDescent(const PosePlanner& planner, const SE3& target);
  PoseDescent(const PoseDescent&) = delete;
  PoseDescent& operator=(const PoseDescent&) = delete;
  PoseDescent(PoseDescent&&) = delete;
  PoseDescent& operator=(PoseDescent&&) = delete;
  ~PoseDescent() = default;

  /// Brings the hand to the target from q, by inverse kinematics within the box. False if it stalls
  /// or the Jacobian there has no full rank.
  bool begin(const JointVector& q) noexcept;

  /// Descends from there. True: point() is feasible and stationary. False, too, where it is as good
  /// as certain that the end would not be below `best`.
  bool descend(int most, double best) noexcept;

  const PosePoint& point() const { return *here_; }
  bool is_feasible() const { return here_->violation <= planner_.options_.tolerance; }
  int iterations() const { return iterations_; }
  const IkProblem& ik() const { return ik_; }

  /// Where the hand came nearest to the target of all that begin() could not bring there.
  const JointVector& nearest_miss() const { return nearest_; }

  /// What a descent from q may come to, the less the better: log sqrt(kappa/M) there in a bound,
  /// and what the inequalities are violated by at a price.
  double rank(const JointVector& q) noexcept;

 private:
  enum class Step : std::uint8_t { kTaken, kRefused, kLast, kStuck };

  static int slacks(const PosePlanner& planner) noexcept;
  bool bring(const JointVector& q, int most, double tolerance, PosePoint& point) noexcept;
  bool derive(PosePoint& point) const noexcept;
  bool evaluate(PosePoint& point) const noexcept;
  bool settle() noexcept;
  bool misses() const noexcept;
  void measure(PosePoint& point) const noexcept;
  double slack_gradient(const PosePoint& point, int i, JointVector& gradient) const noexcept;
  void add_inequalities(JointVector& pull, SmallMatrix& H) noexcept;
  void reduce() noexcept;
  void bound() noexcept;
  Step step(double best) noexcept;
  std::optional<Step> finish(const JointVector& q, double length) noexcept;
  double loose_tolerance(double gain) const noexcept;

  const PosePlanner& planner_;
  IkProblem ik_;
  std::array<PosePoint, 2> points_;
  PosePoint* here_ = points_.data();
  PosePoint* there_ = points_.data() + 1;
  int iterations_ = 0;
  JointVector nearest_;
  double nearest_cost_ = std::numeric_limits<double>::infinity();

  PoseProgram program_;  // of a step
  Vector6 lambda_;       // of the pose
  JointVector back_;     // the shortest way to the target
  double radius_ = 0.0;
};

}  // namespace thing_kin
