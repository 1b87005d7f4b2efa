#include "thing_kin/search/spiral.hpp"

#include <cmath>
#include <numbers>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

void check_spiral(const Eigen::Vector2d& center, const SpiralOptions& options) {
  const auto positive = [](double value, const char* name) {
    if (!(value > 0.0 && std::isfinite(value))) {
      throw InvalidArgument(name, text(value), "a positive number of metres");
    }
  };
  if (!center.allFinite()) {
    throw InvalidArgument("center", "NaN or inf", "finite numbers");
  }
  positive(options.gap, "gap");
  positive(options.spacing, "spacing");
  if (!(options.radius >= 0.0)) {
    throw InvalidArgument("radius", text(options.radius), "a number of metres >= 0");
  }
  if (options.count < 1 || options.count > kMostSearchPoints) {
    throw InvalidArgument("count", std::to_string(options.count), "1 to 1000000");
  }
  if (options.count == kMostSearchPoints && std::isinf(options.radius)) {
    throw InvalidArgument("count", "no count and no radius", "one of them: a spiral has no end");
  }
}

}  // namespace

SearchPoints spiral_points(const Eigen::Vector2d& center, const SpiralOptions& options) {
  check_spiral(center, options);
  const double b = options.gap / (2.0 * std::numbers::pi);
  SearchPoints points{center};
  // r grows with th: the first point beyond the radius is the last of all.
  for (double th = 0.9 * 2.0 * std::numbers::pi;; th += options.spacing / std::hypot(b * th, b)) {
    const double r = b * th;
    if (points.size() >= options.count || r > options.radius) {
      return points;
    }
    if (points.size() >= kMostSearchPoints) {
      throw InvalidArgument("radius", text(options.radius), "at most a million points");
    }
    points.emplace_back(center.x() + r * std::cos(th), center.y() + r * std::sin(th));
  }
}

}  // namespace thing_kin
