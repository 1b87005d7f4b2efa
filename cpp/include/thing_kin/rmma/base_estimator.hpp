#pragma once

#include <array>
#include <vector>

#include "thing_kin/estimation/extended_kalman.hpp"
#include "thing_kin/lie/se2.hpp"
#include "thing_kin/search/covering.hpp"

namespace thing_kin {

/// One guess at how well things are known: factors of the usual deviations.
struct NoiseGuess {
  double odometry = 1.0;
  double bias_length = 0.4;  ///< m: how far the odometry's bias holds
  double drift = 1.0;
  double map = 0.0;  ///< m: deviation of where fiducials are from where they are listed
};

/// The guesses that an estimator weighs against each other.
inline constexpr std::array kNoiseGuesses{
    NoiseGuess{},
    NoiseGuess{.odometry = 2.0},
    NoiseGuess{.odometry = 4.0},
    NoiseGuess{.bias_length = 4.0},
    NoiseGuess{.odometry = 2.5, .bias_length = 4.0},
    NoiseGuess{.drift = 2.5},
    NoiseGuess{.odometry = 2.5, .bias_length = 4.0, .drift = 2.5},
    NoiseGuess{.map = 0.008},
};

/// What a robot has learnt of its noise: log weights of the guesses, kept from side to side.
struct NoiseMemory {
  std::array<double, kNoiseGuesses.size()> log_weight{};
};

/// Where the base is while it drives, from fiducials that were hit and from odometry.
///
/// State (x, y, theta, s, kappa, b_x, b_y, b_theta, c): pose, speed above v_b as a share of it,
/// curvature, the odometry's slow bias, lateral creep. Driving is uncertain per distance, creep and
/// nothing else per time. One extended Kalman filter for each of kNoiseGuesses, weighed by how
/// probable what was observed is to it: a bank.
class BaseEstimator {
 public:
  static constexpr int kStates = 9;

  /// From the displacement that was seen when the first fiducial was registered, at rest.
  BaseEstimator(const Eigen::Vector2d& fiducial, const Eigen::Vector2d& displacement,
                double velocity, double radius, NoiseMemory& memory);

  /// dt seconds of driving.
  void predict(double dt);
  void read_odometry(const Pose2& seen);
  /// The tool, at `displacement` from the base, was within `miss` of a fiducial: mean and
  /// covariance of fiducial minus tool.
  void hit(const Eigen::Vector2d& fiducial, const Eigen::Vector2d& displacement,
           const PlanarNormal& miss);

  /// Mean over the bank.
  const Pose2& pose() const noexcept { return pose_; }
  /// m/s along x, at least 0.3 v_b.
  double speed() const noexcept;
  /// Fiducial minus tool for a tool sent to where it should meet the fiducial: by `displacement`
  /// from pose(). One normal for each member of the bank.
  std::vector<PlanarNormal> offsets(const Eigen::Vector2d& displacement) const;
  /// Of the pose's (x, y) over the bank.
  Eigen::Matrix2d covariance() const;

 private:
  using State = Eigen::Matrix<double, kStates, 1>;

  void predict_member(std::size_t k, double dt, double distance);
  void weigh(std::size_t k);
  void settle();

  double velocity_;
  NoiseMemory* memory_;
  std::vector<ExtendedKalmanFilter> bank_;
  std::array<double, kNoiseGuesses.size()> weight_{};
  Pose2 pose_ = Pose2::Zero();
  double speed_share_ = 0.0;
};

}  // namespace thing_kin
