#pragma once

#include <memory>
#include <string>
#include <vector>

#include "thing_kin/estimation/gaussian_filter.hpp"

namespace thing_kin {

/// How a state moves in dt seconds, with its exact Jacobian and the covariance that its noise adds.
/// Arrays are bare: x (n), F (n, n) in rows, Q (n, n). Angles need not be wrapped.
class MotionModel {
 public:
  virtual ~MotionModel() = default;
  MotionModel(const MotionModel&) = delete;
  MotionModel& operator=(const MotionModel&) = delete;
  MotionModel(MotionModel&&) = delete;
  MotionModel& operator=(MotionModel&&) = delete;

  const std::string& name() const noexcept { return name_; }
  int size() const noexcept { return static_cast<int>(variables_.size()); }
  const std::vector<std::string>& variables() const noexcept { return variables_; }
  const AngleSet& angles() const noexcept { return angles_; }

  /// `out` may be x.
  virtual void step(const double* x, double dt, double* out) const noexcept = 0;
  virtual void jacobian(const double* x, double dt, double* F) const noexcept = 0;
  virtual void noise(const double* x, double dt, double* Q) const noexcept = 0;
  /// Both: what they share is computed once.
  virtual void linearize(const double* x, double dt, double* out, double* F) const noexcept {
    step(x, dt, out);
    jacobian(x, dt, F);
  }

 protected:
  MotionModel(std::string name, std::vector<std::string> variables, const AngleSet& angles = {});

 private:
  std::string name_;
  std::vector<std::string> variables_;
  AngleSet angles_;
};

using MotionModelPtr = std::shared_ptr<const MotionModel>;

/// Positions, then velocities, of `dimension` axes: x <- x + v dt. `noise` is the spectral density
/// of a white acceleration, m^2/s^3. Throws InvalidArgument("dimension" or "noise", ...).
MotionModelPtr constant_velocity(int dimension = 2, double noise = 1.0);

/// Positions, velocities, accelerations: x <- x + v dt + a dt^2/2. `noise` is the spectral density
/// of a white jerk, m^2/s^5.
MotionModelPtr constant_acceleration(int dimension = 2, double noise = 1.0);

/// A planar pose (x, y, theta) and its body twist (vx, vy, omega), which is held: the pose moves by
/// the exponential of twist dt on SE(2), [M17] (3.20). `noise` has the spectral densities of white
/// accelerations along and about the body's axes: (m/s^2)^2 s twice, (rad/s^2)^2 s.
MotionModelPtr constant_twist(const Eigen::Vector3d& noise = Eigen::Vector3d::Ones());

/// The planar mode of robot_localization: x, y, theta, vx, vy, omega, ax, ay, the last five in body
/// axes; position moves along the heading at the beginning of the step. `noise` is the variance
/// that each variable gains per second.
MotionModelPtr omnidirectional(const Eigen::Matrix<double, 8, 1>& noise);
Eigen::Matrix<double, 8, 1> omnidirectional_noise();  ///< the default

}  // namespace thing_kin
