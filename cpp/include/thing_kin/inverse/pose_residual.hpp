#pragma once

#include <array>

#include "thing_kin/kinematics/damped_inverse.hpp"

namespace thing_kin {

/// The axes in which the coordinates of a pose error are counted.
enum class WeightAxes : std::uint8_t { kTarget, kWorld };

WeightAxes weight_axes_from_string(const std::string& name);

/// How much each coordinate of a pose [linear, angular] matters; 0: it is free.
struct PoseWeights {
  std::array<double, 6> weight{1, 1, 1, 1, 1, 1};
  WeightAxes axes = WeightAxes::kTarget;
};

/// The difference between a pose and its target, as least squares sees it: weighted, metres and
/// radians made one by a length, without the coordinates that are free.
class PoseResidual {
 public:
  struct Value {
    Vector6 e;              ///< weighted
    Eigen::Vector3d log;    ///< log(R_goal R^T), axes of the world
    double curvature;       ///< (1 - (a/2) cot(a/2))/a^2 of the angle a = |log|
    double position_error;  ///< m, of the coordinates that count
    double rotation_error;  ///< rad, of the coordinates that count
    double cost() const { return 0.5 * e.squaredNorm(); }
  };

  /// length, m: a position error of one length counts as one radian.
  PoseResidual(const SE3& target, const PoseWeights& weights, double length) noexcept;

  /// The residual e of T.
  void evaluate(const SE3& T, Value& value) const noexcept;

  /// M J is the Jacobian of -e, exactly, where J is the geometric one (world_aligned). It has the
  /// derivative of the logarithm: log(exp(e) exp(-w)) = e - J_r^-1(e) w to first order.
  RowFactors derivative(const Value& value) const noexcept;

  /// The cost, near enough to choose where to begin: `way` to the target, and 3 - tr(R_goal R^T),
  /// which is the square of a small angle. No coordinate counts less than the others of its part.
  double rough_cost(const Eigen::Vector3d& way, double turned) const noexcept {
    const double linear = scale_.head<3>().maxCoeff();
    const double angular = scale_.tail<3>().maxCoeff();
    return 0.5 * (linear * linear * way.squaredNorm() + angular * angular * turned);
  }

  const SE3& target() const { return target_; }
  bool has_position() const { return has_position_; }
  bool has_rotation() const { return has_rotation_; }

  /// Whether all three coordinates of each part count the same: then e is of the world's axes.
  bool is_isotropic() const { return isotropic_; }
  double position_scale() const { return scale_[0]; }
  double rotation_scale() const { return scale_[3]; }

 private:
  SE3 target_;
  Vector6 scale_;
  Vector6 counts_;  // 1 or 0
  bool has_position_;
  bool has_rotation_;
  bool isotropic_;
  bool target_axes_;
};

}  // namespace thing_kin
