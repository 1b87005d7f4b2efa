#pragma once

#include <Eigen/Core>

#include "thing_kin/lie/se2.hpp"

namespace thing_kin {

/// Where the arm is, as a displacement of the tool from the base in the base's axes, m.
struct ArmPlacement {
  Eigen::Vector2d actual;
  Eigen::Vector2d seen;  ///< by forward kinematics
};

/// One drive along one side of the artifact: what happens, whoever searches. Times are seconds
/// since the side's first fiducial was registered; poses are in the side's frame, in which the base
/// sets off along +x. Times of one function never fall from call to call.
class WorldRun {
 public:
  virtual ~WorldRun() = default;
  WorldRun(const WorldRun&) = delete;
  WorldRun& operator=(const WorldRun&) = delete;
  WorldRun(WorldRun&&) = delete;
  WorldRun& operator=(WorldRun&&) = delete;

  virtual Pose2 pose(double t) = 0;
  /// What the base's localization says.
  virtual Pose2 odometry(double t) = 0;
  /// The arm stops where it is sent, nearly. After move_time() it was a move to another place.
  virtual ArmPlacement place(const Eigen::Vector2d& command) = 0;
  /// Whether the laser, read at a stop of the tool, sees the fiducial listed at `fiducial`.
  virtual bool detects(const Eigen::Vector2d& tool, const Eigen::Vector2d& fiducial) = 0;
  /// s, of a move from one place of work to the next.
  virtual double move_time(const Eigen::Vector2d& from, const Eigen::Vector2d& to) = 0;
  /// s, from one reading of the laser to the next.
  virtual double sample_time(const Eigen::Vector2d& from, const Eigen::Vector2d& to) = 0;
  /// Whether the arm can be sent there.
  virtual bool reaches(const Eigen::Vector2d& command) = 0;

 protected:
  WorldRun() = default;
};

}  // namespace thing_kin
