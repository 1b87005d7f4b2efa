#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

namespace thing_kin {

/// Where a tool is to look, in the order in which it looks.
using SearchPoints = std::vector<Eigen::Vector2d>;

/// More would be a mistake.
inline constexpr std::size_t kMostSearchPoints = 1'000'000;

struct SpiralOptions {
  double gap = 0.0;      ///< m between neighbouring turns, > 0
  double spacing = 0.0;  ///< m along the spiral from point to point, > 0
  double radius = std::numeric_limits<double>::infinity();  ///< m: what lies beyond is dropped
  std::size_t count = kMostSearchPoints;                    ///< at most; one of the two must end it
};

/// Evenly spaced points on an Archimedean spiral about `center`, counter-clockwise, [X21] 2.2:
/// r = b th, b = gap / 2 pi; the center, then th = 0.9 turns, then steps of spacing / hypot(r, b).
/// Throws InvalidArgument naming what is wrong.
SearchPoints spiral_points(const Eigen::Vector2d& center, const SpiralOptions& options);

}  // namespace thing_kin
