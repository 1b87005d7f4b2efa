#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "thing_kin/odometry/planar_motion.hpp"
#include "thing_kin/odometry/scan_matching.hpp"

namespace thing_kin {

enum class LaserStatus : std::uint8_t {
  kFirst,     ///< the first scan with points: where poses begin
  kTracking,  ///< found in the map
  kStill,     ///< found, and no motion is seen: the pose is held
  kLost       ///< not found: the pose goes on with the guess
};

struct LaserOdometryOptions {
  double keyframe_distance = 0.15;  ///< m; a scan goes into the map after so much motion
  double keyframe_angle = 0.3;      ///< rad
  double memory = 30.0;             ///< m of way, after which what was not seen is forgotten
  double radius = 30.0;             ///< m around the robot; what is further is forgotten
  double still_distance = 0.005;    ///< m; within it and its own noise no motion is seen
  double still_angle = 0.005;       ///< rad
  int lost_limit = 10;              ///< scans in a row that are lost; then the map begins anew
  MatchOptions match;
};

/// What one scan said.
struct LaserStep {
  LaserStatus status = LaserStatus::kFirst;
  Pose2 pose = Pose2::Zero();    ///< of the robot when the scan began; the first one's is zero
  Pose2 motion = Pose2::Zero();  ///< T_before_now
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the motion, in the axes of before
  /// The same without what the guess says: to fuse with the guess's source.
  Eigen::Matrix3d scan_covariance = Eigen::Matrix3d::Zero();
  double t = 0.0;
  double t_from = 0.0;
  bool keyframe = false;  ///< the scan went into the map
  ScanMatch match;
};

/// Follows a robot by its laser scans: each is matched to a map of what was seen on the last
/// metres. No loop is closed: what lies further back is forgotten, on purpose.
class LaserOdometry {
 public:
  /// Throws InvalidArgument naming the field.
  LaserOdometry(const Scanner& scanner, const LaserOdometryOptions& options);

  /// One scan that began at t, in s, later than the one before. `motion`: since then, as measured
  /// by something else (wheels); else velocity is assumed constant. `during`: while the scan was
  /// made, as measured; else the mean twist since the scan before goes on. Throws
  /// InvalidArgument("t", ...); the state is then as it was.
  LaserStep add(std::span<const double> ranges, double t,
                const std::optional<PlanarEstimate>& motion,
                const std::optional<ScanMotion>& during = std::nullopt);

  const Scanner& scanner() const noexcept { return scanner_; }
  const LaserOdometryOptions& options() const noexcept { return options_; }
  const LocalMap& map() const noexcept { return map_; }
  const Pose2& pose() const noexcept { return pose_; }

 private:
  PlanarEstimate guess_motion(double dt, const std::optional<PlanarEstimate>& motion) const;
  ScanMatch match(const MatchGuess& guess, bool guided) const;
  MatchGuess guess_pose(const PlanarEstimate& moved, bool measured) const;
  ScanMatch find(std::span<const double> ranges, const MatchGuess& guess, const Twist2& twist,
                 double dt);
  void begin(const PlanarEstimate& moved, LaserStep& step);
  void follow(const ScanMatch& match, const PlanarEstimate& moved, LaserStep& step);
  void spread(const Pose2& before, const PlanarEstimate& moved, LaserStep& step);
  void count_lost(LaserStep& step);
  bool seems_still(const ScanMatch& match) const;
  void keep(LaserStep& step);

  Scanner scanner_;
  LaserOdometryOptions options_;
  LocalMap map_;
  PlanarScan scan_;
  Pose2 pose_ = Pose2::Zero();
  Eigen::Matrix3d noise_ = Eigen::Matrix3d::Zero();   ///< of pose_ in the map
  Eigen::Matrix3d untold_ = Eigen::Matrix3d::Zero();  ///< columns: what the scan at pose_ left open
  Twist2 twist_ = Twist2::Zero();
  Pose2 keyframe_ = Pose2::Zero();
  std::optional<double> t_;
  double dt_ = 0.0;  ///< between the last two scans
  double way_ = 0.0;
  int lost_ = 0;
};

}  // namespace thing_kin
