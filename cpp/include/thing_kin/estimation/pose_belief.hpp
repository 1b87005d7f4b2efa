#pragma once

#include <cstdint>
#include <vector>

#include "thing_kin/lie/se2.hpp"

namespace thing_kin {

/// The most past poses that a belief may hold beside the present one.
inline constexpr int kMaxClones = 8;
inline constexpr int kMaxBeliefSize = 3 + 3 * kMaxClones;

/// How a heading's uncertainty is carried through the turn of a displacement.
enum class PoseFilter : std::uint8_t { kExtended, kUnscented };

/// A stretch of motion with a constant twist.
struct PlanarStep {
  Twist2 xi;                   ///< twist times seconds, in the body
  Eigen::Matrix3d covariance;  ///< of xi
  Eigen::Matrix3d noise;       ///< process noise of the whole stretch, world axes
};

/// What is measured: three numbers, of which some count, with bounds for the gate.
struct PoseMeasurement {
  Pose2 z;
  Eigen::Matrix3d R;
  std::uint8_t rows = 7;  ///< bit k: whether z[k] counts
  double gate = 0.0;      ///< the largest NIS that is accepted
};

struct PoseVerdict {
  bool accepted = false;
  double nis = 0.0;
  int dof = 0;  ///< 0: there was nothing to compare it with
};

/// A Gaussian over the present planar pose and clones of past ones, errors in world axes.
///
/// A clone stays correlated with the present as it should be ("stochastic cloning"): a motion
/// between two times then tells what it tells beyond the odometry of that stretch, once.
class PoseBelief {
 public:
  PoseBelief(const Pose2& pose, Eigen::Matrix3d P);

  const Pose2& pose() const noexcept { return pose_; }
  const Eigen::Matrix3d& P() const noexcept { return P_; }

  /// pose <- pose exp(xi)
  void predict(const PlanarStep& step, PoseFilter filter) noexcept;

  /// Rows of the pose itself, in world axes.
  PoseVerdict update(const PoseMeasurement& measured) noexcept;

  /// The present as the clone sees it, in the clone's axes. Not accepted without that clone.
  PoseVerdict update_relative(std::uint64_t id, const PoseMeasurement& measured,
                              PoseFilter filter) noexcept;

  /// From now on the present pose is kept under this id. False if there are kMaxClones.
  bool clone(std::uint64_t id);
  void forget(std::uint64_t id) noexcept;

  /// Everything as numbers, and back: for saving.
  std::vector<double> numbers() const;
  static PoseBelief from_numbers(const std::vector<double>& numbers);

 private:
  struct Clone {
    std::uint64_t id;
    Pose2 pose;
  };
  using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxBeliefSize>;
  int find(std::uint64_t id) const noexcept;
  PoseVerdict update_joint(const Rows& H, const Eigen::Vector3d& r, const Eigen::Matrix3d& R,
                           const PoseMeasurement& measured) noexcept;

  Pose2 pose_;
  Eigen::Matrix3d P_;
  // Empty, and so without memory, as long as there is no clone.
  std::vector<Clone> clones_;
  Eigen::Matrix3Xd cross_;  ///< present with clones
  Eigen::MatrixXd P_clones_;
};

}  // namespace thing_kin
