#include <algorithm>
#include <cmath>
#include <vector>

#include "mecanum_fit.hpp"

namespace thing_kin {

namespace {

constexpr double kTurning = 0.1;     // rad: a window that turns less does not show k
constexpr double kLeastMove = 0.02;  // m

struct Hints {
  std::vector<double> length_ratios;  // reference over wheels
  std::vector<double> turn_ratios;
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();  // of the reference as the wheels see it
};

Hints hints_of(const std::vector<ReferenceWindow>& windows,
               const std::vector<WheelMotion>& rolled) {
  double longest = 0.0;
  for (const WheelMotion& motion : rolled) {
    longest = std::max(longest, motion.pose.head<2>().norm());
  }
  Hints hints;
  for (std::size_t i = 0; i < rolled.size(); ++i) {
    if (!rolled[i].whole) {
      continue;
    }
    const Pose2 seen = between(windows[i].pose, windows[i + 1].pose);
    const Pose2& wheels = rolled[i].pose;
    const double length = wheels.head<2>().norm() * seen.head<2>().norm();
    if (wheels.head<2>().norm() > 0.3 * longest && length > kLeastMove * kLeastMove) {
      hints.length_ratios.push_back(seen.head<2>().norm() / wheels.head<2>().norm());
      const double cosine = wheels.head<2>().dot(seen.head<2>());
      const double sine = wheels.x() * seen.y() - wheels.y() * seen.x();
      hints.direction += Eigen::Vector2d(cosine, sine) / length;
    }
    if (std::abs(seen.z()) > kTurning && std::abs(wheels.z()) > 1e-6) {
      hints.turn_ratios.push_back(seen.z() / wheels.z());
    }
  }
  return hints;
}

// Sum of the motions' errors, whose outliers count once: what a clock offset is judged by.
double misfit(const std::vector<ReferenceWindow>& windows, const std::vector<WheelMotion>& rolled) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rolled.size(); ++i) {
    const Pose2 seen = between(windows[i].pose, windows[i + 1].pose);
    sum += std::abs(seen.head<2>().norm() - rolled[i].pose.head<2>().norm());
    sum += 0.3 * std::abs(wrap_angle(seen.z() - rolled[i].pose.z()));
  }
  return sum / static_cast<double>(std::max<std::size_t>(rolled.size(), 1));
}

}  // namespace

void MecanumFit::guess() {
  linearize();
  Hints hints = hints_of(windows_, rolled_);
  const double ratio =
      hints.length_ratios.empty() ? 1.0 : std::max(1e-3, median_of(hints.length_ratios));
  x[0] += held[0] ? 0.0 : std::log(ratio);
  if (!held[1] && hints.turn_ratios.size() >= 3) {
    x[1] +=
        (held[0] ? 0.0 : std::log(ratio)) - std::log(std::max(1e-3, median_of(hints.turn_ratios)));
  }
  if (!held[4] && hints.direction.norm() > 0.0) {
    x[4] = -std::atan2(hints.direction.y(), hints.direction.x());
  }
  if (held[5]) {
    return;
  }
  const double step = std::min(0.1, 0.25 * window_);
  const int most = static_cast<int>(std::min(200.0, std::ceil(3.0 * prior_std[5] / step)));
  const std::size_t least = rolled_.size() / 2;  // fewer may agree by chance, and none always do
  double best = std::numeric_limits<double>::infinity();
  double offset = 0.0;
  for (int i = -most; i <= most; ++i) {
    x[5] = i * step;
    linearize();
    const double here = misfit(windows_, rolled_);
    if (rolled_.size() >= least && here < best) {
      best = here;
      offset = x[5];
    }
  }
  x[5] = offset;
}

}  // namespace thing_kin
