#include "thing_kin/odometry/wheel_path.hpp"

#include <algorithm>
#include <cmath>

#include "thing_kin/odometry/mecanum.hpp"

namespace thing_kin {

namespace {

// Rims that move less than this in a gap of the record have not moved, m.
constexpr double kStandingTravel = 1e-3;

}  // namespace

WheelMotion combine(const WheelMotion& first, const WheelMotion& second) {
  const Eigen::Matrix3d back = se2_adjoint(inverse(second.pose));
  WheelMotion both;
  both.pose = compose(first.pose, second.pose);
  both.sensitivity = back * first.sensitivity + second.sensitivity;
  both.covariance = back * first.covariance * back.transpose() + second.covariance;
  both.travel = first.travel + second.travel;
  both.whole = first.whole && second.whole;
  return both;
}

WheelPath::WheelPath(std::span<const double> t, std::span<const Eigen::Vector4d> angles,
                     double longest_gap)
    : t_(t.begin(), t.end()), longest_gap_(longest_gap) {
  const Eigen::Matrix<double, 3, 4> M = unit_mecanum_matrix();
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const Eigen::Vector4d turned = angles[i + 1] - angles[i];
    steps_.push_back({M * turned, turned.cwiseAbs().mean()});
  }
  set(1.0, 1.0, 0.0);
}

void WheelPath::set(double wheel_radius, double k, double clock_offset) {
  wheel_radius_ = wheel_radius;
  k_ = k;
  clock_offset_ = clock_offset;
  poses_.assign(t_.size(), Pose2::Zero());
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    poses_[i + 1] = compose(poses_[i], se2_exp(scaled(steps_[i].unit)));
  }
}

Twist2 WheelPath::scaled(const Twist2& unit) const {
  return {wheel_radius_ * unit.x(), wheel_radius_ * unit.y(), wheel_radius_ / k_ * unit.z()};
}

// The step whose time holds the stamp, the first or the last for what is outside.
std::size_t WheelPath::step_at(double stamp) const {
  const auto after = std::ranges::upper_bound(t_, stamp);
  const auto index = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - t_.begin(), 1));
  return std::min(index, steps_.size()) - 1;
}

double WheelPath::fraction(std::size_t step, double stamp) const {
  const double duration = t_[step + 1] - t_[step];
  return duration > 0.0 ? std::clamp((stamp - t_[step]) / duration, 0.0, 1.0) : 1.0;
}

Twist2 WheelPath::velocity_at(double stamp) const {
  const std::size_t step = step_at(stamp);
  const double duration = t_[step + 1] - t_[step];
  return duration > 0.0 ? Twist2(scaled(steps_[step].unit) / duration) : Twist2::Zero();
}

Pose2 WheelPath::pose_at(double t) const {
  const double stamp = t + clock_offset_;
  const std::size_t step = step_at(stamp);
  return compose(poses_[step], se2_exp(scaled(steps_[step].unit) * fraction(step, stamp)));
}

void WheelPath::add(std::size_t step, double part, const Eigen::Vector3d& variance,
                    WheelMotion& to) const {
  const Twist2 xi = part * scaled(steps_[step].unit);
  const double travel = part * wheel_radius_ * steps_[step].travel;
  const Pose2 moved = se2_exp(xi);
  const Eigen::Matrix3d back = se2_adjoint(inverse(moved));
  const Eigen::Matrix3d right = se2_right_jacobian(xi);
  Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
  slope.col(0) = xi;      // by log R
  slope(2, 1) = -xi.z();  // by log k
  to.sensitivity = back * to.sensitivity + right * slope;
  to.covariance = back * to.covariance * back.transpose();
  to.covariance += right * (travel * variance).asDiagonal() * right.transpose();
  to.pose = compose(to.pose, moved);
  to.travel += travel;
  to.whole = to.whole && (t_[step + 1] - t_[step] <= longest_gap_ || travel <= kStandingTravel);
}

WheelMotion WheelPath::motion(double from, double to, const Eigen::Vector3d& variance) const {
  WheelMotion motion;
  const std::size_t first = step_at(from + clock_offset_);
  const std::size_t last = step_at(to + clock_offset_);
  for (std::size_t step = first; step <= last; ++step) {
    const double begin = step == first ? fraction(step, from + clock_offset_) : 0.0;
    const double end = step == last ? fraction(step, to + clock_offset_) : 1.0;
    add(step, end - begin, variance, motion);
  }
  const Eigen::Matrix3d back = se2_adjoint(inverse(motion.pose));
  motion.sensitivity.col(2) =
      velocity_at(to + clock_offset_) - back * velocity_at(from + clock_offset_);
  return motion;
}

}  // namespace thing_kin
