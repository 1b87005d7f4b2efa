#include "thing_kin/rmma/side_search.hpp"

#include <cmath>

#include "thing_kin/rmma/world.hpp"

namespace thing_kin {

using Eigen::Vector2d;

std::size_t next_fiducial(const SearchPoints& side, std::size_t previous,
                          double travelled) noexcept {
  std::size_t best = side.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = previous + 1; i < side.size(); ++i) {
    const double away = std::abs(std::abs(side[i].x() - side.front().x()) - travelled);
    if (away < least) {
      least = away;
      best = i;
    }
  }
  return best;
}

double SearchArm::move_to(const Vector2d& command) {
  const double time = run_.move_time(command_, command);
  command_ = command;
  return time;
}

double SearchArm::sample_at(const Vector2d& command) {
  const double time = run_.sample_time(command_, command);
  command_ = command;
  return time;
}

bool SearchArm::sees(double t, const Vector2d& fiducial, SearchTrace* trace) {
  placement_ = run_.place(command_);
  const Pose2 base = run_.pose(t);
  const Vector2d tool =
      compose(base, Pose2(placement_.actual.x(), placement_.actual.y(), 0.0)).head<2>();
  if (trace != nullptr) {
    trace->times.push_back(t);
    trace->tools.push_back(tool);
  }
  return run_.detects(tool, fiducial);
}

bool register_first(SearchArm& arm, const Vector2d& fiducial) {
  constexpr int kAttempts = 5;
  constexpr int kMore = 20;
  for (int attempt = 0; attempt < kAttempts + kMore; ++attempt) {
    const bool wide = attempt >= kAttempts;
    const double gap = wide ? 0.002 : 0.005;
    const SearchPoints points = spiral_points(
        first_displacement(), {.gap = gap, .spacing = gap, .count = wide ? 3000U : 45U});
    for (const Vector2d& point : points) {
      if (!arm.run().reaches(point)) {
        continue;
      }
      if (&point == &points.front()) {
        arm.move_to(point);
      } else {
        arm.sample_at(point);
      }
      if (arm.sees(0.0, fiducial, nullptr)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace thing_kin
