#include "reference_windows.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

namespace thing_kin {

namespace {

// The median absolute deviation of a normal distribution times this is its standard deviation.
constexpr double kDeviationOfMedian = 1.4826;
// Neighbouring poses of a tracker share part of their error: so many count as one.
constexpr double kSharedErrors = 4.0;
// No reference is better than this in a window: 0.1 mm, 0.1 mrad.
constexpr double kLeastVariance = 1e-8;

// Median pose of a window, with its variance.
ReferenceWindow summarize(double t, const std::array<std::vector<double>, 3>& carried,
                          const Pose2& first) {
  ReferenceWindow window;
  window.t = t;
  const auto count = static_cast<double>(carried[0].size());
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> numbers = carried[c];
    const double middle = median_of(numbers);
    for (double& number : numbers) {
      number = std::abs(number - middle);
    }
    const double deviation = kDeviationOfMedian * median_of(numbers);
    const auto i = static_cast<Eigen::Index>(c);
    window.pose[i] = first[i] + middle;
    window.variance[i] = std::max(kLeastVariance, deviation * deviation * kSharedErrors / count);
  }
  window.pose.z() = wrap_angle(window.pose.z());
  return window;
}

// The reference poses [begin, end), carried to time t by the wheels.
ReferenceWindow window_of(const ReferenceRecord& reference, std::size_t begin, std::size_t end,
                          double t, const WheelPath& wheels, const Pose2& mount) {
  const Pose2 middle = compose(wheels.pose_at(t), mount);
  std::array<std::vector<double>, 3> carried;
  Pose2 first;
  for (std::size_t i = begin; i < end; ++i) {
    const Pose2 then = compose(wheels.pose_at(reference.t[i]), mount);
    const Pose2 pose = compose(reference.poses[i], between(then, middle));
    first = i == begin ? pose : first;
    const Eigen::Vector3d off = pose_difference(pose, first);
    for (std::size_t c = 0; c < 3; ++c) {
      carried[c].push_back(off[static_cast<Eigen::Index>(c)]);
    }
  }
  return summarize(t, carried, first);
}

Eigen::Matrix3d turned_by(double angle) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return turn;
}

}  // namespace

double median_of(std::vector<double>& numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::ranges::nth_element(numbers, middle);
  return *middle;
}

std::vector<ReferenceWindow> cut_windows(const ReferenceRecord& reference, const WheelPath& wheels,
                                         const Pose2& mount, double duration) {
  std::vector<ReferenceWindow> windows;
  const double last = std::min(wheels.last(), reference.t.back());
  // Windows begin where the reference does: a clock offset does not move them.
  const double origin = reference.t.front();
  auto begin = static_cast<std::size_t>(std::ranges::lower_bound(reference.t, wheels.first()) -
                                        reference.t.begin());
  while (begin < reference.t.size() && reference.t[begin] <= last) {
    const double index = std::floor((reference.t[begin] - origin) / duration);
    const double from = origin + index * duration;
    std::size_t end = begin + 1;
    while (end < reference.t.size() && reference.t[end] < from + duration &&
           reference.t[end] <= last) {
      ++end;
    }
    // The middle of what was seen, which may be less than the window.
    const double middle = 0.5 * (reference.t[begin] + reference.t[end - 1]);
    windows.push_back(window_of(reference, begin, end, middle, wheels, mount));
    begin = end;
  }
  return windows;
}

RelativeMotion relative_motion(const ReferenceWindow& from, const ReferenceWindow& to,
                               const WheelMotion& rolled, const Pose2& mount) {
  const Pose2 seen = between(from.pose, to.pose);  // of the reference's body
  const Pose2 robot = compose(compose(mount, seen), inverse(mount));
  const Pose2 left = between(rolled.pose, robot);
  RelativeMotion motion;
  motion.error = se2_log(left);
  const Eigen::Matrix3d slope = se2_right_jacobian(motion.error).inverse();
  const Eigen::Matrix3d of_mount = slope * se2_adjoint(mount);
  // By the mount: at the motion that the wheels predict. At the one seen, the reference's noise in
  // it would pass for turning, and bias the mount (an instrumental variable).
  const Pose2 predicted = compose(compose(inverse(mount), rolled.pose), mount);
  const Eigen::Matrix3d back = se2_adjoint(inverse(predicted));
  const Eigen::Matrix3d of_wheels = -slope * se2_adjoint(inverse(left));
  motion.J.col(0) = of_wheels * rolled.sensitivity.col(0);
  motion.J.col(1) = of_wheels * rolled.sensitivity.col(1);
  motion.J.middleCols<3>(2) =
      of_mount * (back - Eigen::Matrix3d::Identity()) * turned_by(-mount.z());
  motion.J.col(5) = of_wheels * rolled.sensitivity.col(2);
  motion.wheels = of_wheels * rolled.covariance * of_wheels.transpose();
  motion.by_from = -of_mount * back * turned_by(-from.pose.z());
  motion.by_to = of_mount * turned_by(-to.pose.z());
  motion.travel = rolled.travel;
  motion.whole = rolled.whole;
  return motion;
}

}  // namespace thing_kin
