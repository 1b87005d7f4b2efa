#include "thing_kin/odometry/correlative_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <span>
#include <tuple>

#include <Eigen/Geometry>

namespace thing_kin {

namespace {

using Eigen::Vector2d;

constexpr double kResolution = 0.05;  // m
constexpr double kTurn = std::numbers::pi / 180.0;
constexpr int kLevels = 5;                 // the coarsest cell is 2^4 of the finest
constexpr double kLikelihoodWidth = 0.08;  // m, one standard deviation
constexpr int kKernel = 4;                 // cells to each side
constexpr double kFarthestPoint = 15.0;    // m; farther ones move too much with a degree
constexpr std::size_t kMostSearchPoints = 120;
constexpr double kLeastScore = 0.2;
constexpr double kLeastShareOfBest = 0.6;
// Candidates are apart by one of these, m and rad.
constexpr double kApart = 0.3;
constexpr double kApartTurn = 0.15;

// Row by row.
using Bytes = std::vector<std::uint8_t>;

// Likelihoods as bytes; level l holds in each cell the largest of 2^l x 2^l cells from it on.
class LikelihoodGrid {
 public:
  // Megabytes that are not worth having anew for each search.
  using Memory = std::array<Bytes, kLevels>;

  LikelihoodGrid(const LocalMap& map, const Vector2d& center, double radius, Memory& memory)
      : origin_(center - Vector2d::Constant(radius)),
        side_(static_cast<int>(2.0 * radius / kResolution) + 1),
        levels_(memory) {
    levels_[0].assign(cells(), 0);
    for (const Surfel& surfel : map.surfels()) {
      spread((surfel.p - origin_) / kResolution);
    }
    for (std::size_t l = 1; l < kLevels; ++l) {
      levels_[l].resize(cells());
      pool(levels_[l - 1].data(), 1 << (l - 1), levels_[l].data());
    }
  }

  // Of the cell in which p lies; p is inside.
  std::int32_t cell(const Vector2d& p) const {
    const Eigen::Vector2i at = ((p - origin_) * (1.0 / kResolution)).cast<int>();
    return static_cast<std::int32_t>(index(at.x(), at.y()));
  }

  // The mean over the points (their cells) moved by (x, y) cells; at a coarse level a bound from
  // above for all moves of the cell that begins there. No move leaves the grid.
  double score(std::span<const std::int32_t> points, int x, int y, int level) const {
    const std::uint8_t* values = levels_[static_cast<std::size_t>(level)].data() + y * side_ + x;
    std::int32_t sum = 0;
    for (const std::int32_t point : points) {
      sum += values[point];
    }
    return sum / (255.0 * static_cast<double>(points.size()));
  }

 private:
  std::size_t cells() const {
    return static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
           static_cast<std::size_t>(x);
  }

  void spread(const Vector2d& at) {
    const int x = static_cast<int>(std::floor(at.x()));
    const int y = static_cast<int>(std::floor(at.y()));
    if (x < kKernel || y < kKernel || x >= side_ - kKernel || y >= side_ - kKernel) {
      return;
    }
    constexpr double kWidth = kLikelihoodWidth / kResolution;
    std::array<double, 2 * kKernel + 1> across{};
    std::array<double, 2 * kKernel + 1> along{};
    for (int i = -kKernel; i <= kKernel; ++i) {
      const double dx = (x + i + 0.5 - at.x()) / kWidth;
      const double dy = (y + i + 0.5 - at.y()) / kWidth;
      across[static_cast<std::size_t>(i + kKernel)] = std::exp(-0.5 * dx * dx);
      along[static_cast<std::size_t>(i + kKernel)] = std::exp(-0.5 * dy * dy);
    }
    for (std::size_t j = 0; j < along.size(); ++j) {
      for (std::size_t i = 0; i < across.size(); ++i) {
        std::uint8_t& cell =
            levels_[0][index(x + static_cast<int>(i) - kKernel, y + static_cast<int>(j) - kKernel)];
        cell = std::max(cell, static_cast<std::uint8_t>(255.0 * across[i] * along[j]));
      }
    }
  }

  // Each cell's largest and those `step` ahead of it, as far as there are cells.
  void pool(const std::uint8_t* fine, int step, std::uint8_t* __restrict out) const {
    for (int y = 0; y < side_; ++y) {
      const std::uint8_t* own = fine + y * side_;
      const std::uint8_t* ahead = y + step < side_ ? own + step * side_ : own;
      std::uint8_t* __restrict row = out + y * side_;
      const int inside = side_ - step;
      for (int x = 0; x < inside; ++x) {
        const std::uint8_t here = std::max(own[x], own[x + step]);
        const std::uint8_t above = std::max(ahead[x], ahead[x + step]);
        row[x] = std::max(here, above);
      }
      for (int x = std::max(inside, 0); x < side_; ++x) {
        row[x] = std::max(own[x], ahead[x]);
      }
    }
  }

  Vector2d origin_;
  int side_;
  Memory& levels_;
};

struct Node {
  double score;
  int turn;
  int x;
  int y;
  int level;

  // The whole order, so that equal scores leave no choice.
  bool operator<(const Node& other) const {
    return std::tie(score, other.level, other.turn, other.x, other.y) <
           std::tie(other.score, level, turn, x, y);
  }
};

std::vector<Vector2d> thinned(const PlanarScan& scan) {
  std::vector<Vector2d> near;
  for (const ScanPoint& point : scan) {
    if (point.p.squaredNorm() < kFarthestPoint * kFarthestPoint) {
      near.push_back(point.p);
    }
  }
  const std::size_t stride = (near.size() + kMostSearchPoints - 1) / kMostSearchPoints;
  std::vector<Vector2d> some;
  for (std::size_t i = 0; i < near.size(); i += std::max<std::size_t>(stride, 1)) {
    some.push_back(near[i]);
  }
  return some;
}

bool apart(const SearchCandidate& a, const Pose2& b) {
  const Pose2 d = pose_difference(a.pose, b);
  return std::abs(d.z()) >= kApartTurn || d.head<2>().norm() >= kApart;
}

}  // namespace

std::vector<SearchCandidate> correlative_search(const LocalMap& map, const PlanarScan& scan,
                                                const SearchWindow& window, int most) {
  const std::vector<Vector2d> points = thinned(scan);
  std::vector<SearchCandidate> found;
  if (points.empty() || map.surfels().empty()) {
    return found;
  }
  const double farthest =
      std::ranges::max(points, {}, [](const Vector2d& p) { return p.squaredNorm(); }).norm();
  const Pose2& center = window.center;
  // The coarsest cells reach 0.75 m beyond a move.
  thread_local LikelihoodGrid::Memory memory;
  const LikelihoodGrid grid(map, center.head<2>(), farthest + window.translation + 1.0, memory);
  const int turns = static_cast<int>(window.rotation / kTurn);
  const int reach = static_cast<int>(window.translation / kResolution);
  std::vector<std::int32_t> turned;
  turned.reserve(static_cast<std::size_t>(2 * turns + 1) * points.size());
  std::priority_queue<Node> queue;
  const auto push = [&](int turn, int x, int y, int level) {
    const std::span<const std::int32_t> cells(
        turned.data() + static_cast<std::size_t>(turn) * points.size(), points.size());
    const double score = grid.score(cells, x, y, level);
    if (score > kLeastScore && (found.empty() || score > kLeastShareOfBest * found[0].score)) {
      queue.push({.score = score, .turn = turn, .x = x, .y = y, .level = level});
    }
  };
  constexpr int kCoarsest = 1 << (kLevels - 1);
  for (int turn = 0; turn <= 2 * turns; ++turn) {
    const Eigen::Matrix2d R =
        Eigen::Rotation2Dd(center.z() + (turn - turns) * kTurn).toRotationMatrix();
    for (const Vector2d& p : points) {
      turned.push_back(grid.cell(R * p + center.head<2>()));
    }
    for (int x = -reach; x <= reach; x += kCoarsest) {
      for (int y = -reach; y <= reach; y += kCoarsest) {
        push(turn, x, y, kLevels - 1);
      }
    }
  }
  while (!queue.empty() && std::ssize(found) < most) {
    const Node node = queue.top();
    queue.pop();
    if (node.level == 0) {
      const Pose2 pose(center.x() + node.x * kResolution, center.y() + node.y * kResolution,
                       wrap_angle(center.z() + (node.turn - turns) * kTurn));
      if (std::ranges::all_of(found, [&](const auto& other) { return apart(other, pose); })) {
        found.push_back({.pose = pose, .score = node.score});
      }
      continue;
    }
    const int half = 1 << (node.level - 1);
    for (const int x : {node.x, node.x + half}) {
      for (const int y : {node.y, node.y + half}) {
        if (x <= reach && y <= reach) {
          push(node.turn, x, y, node.level - 1);
        }
      }
    }
  }
  return found;
}

}  // namespace thing_kin
