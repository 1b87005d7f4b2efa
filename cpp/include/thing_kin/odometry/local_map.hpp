#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "thing_kin/odometry/scan.hpp"

namespace thing_kin {

/// A piece of what scans have seen: the mean of the points that fell there.
struct Surfel {
  Eigen::Vector2d p;
  Eigen::Vector2d normal;  ///< towards where it was seen from; zero: a place without a line
  double weight = 1.0;     ///< how many points made it
  double seen = 0.0;       ///< when it was seen last, on the clock of insert()
  /// The line of its surface here, a mean over the neighborhood; of a place, p and zero.
  Eigen::Vector2d line_p;
  Eigen::Vector2d line_normal;

  bool is_surface() const noexcept { return !normal.isZero(0.0); }
};

/// What the scanner has seen lately around the robot: points with their surface's normal, merged
/// where they are closer than `kMergeDistance`, found again through a grid. Both sides of a thin
/// wall are kept apart by their normals.
class LocalMap {
 public:
  /// m. A point goes to the surfel of its kind within this distance, if there is one.
  static constexpr double kMergeDistance = 0.05;

  /// Adds the points of a scan that was made at this pose; sparse ones are not kept.
  void insert(const PlanarScan& scan, const Pose2& pose, double clock);

  /// Forgets what lies beyond `radius` from here or was not seen since `oldest`.
  void forget(const Eigen::Vector2d& center, double radius, double oldest);

  void clear() noexcept;

  /// The nearest surfel within `distance` of p; for a point with a normal it is a surface that
  /// faces the same way. nullptr if there is none.
  const Surfel* nearest(const Eigen::Vector2d& p, const Eigen::Vector2d& normal,
                        double distance) const noexcept;

  /// The same; and how far p may move so that it stays the nearest, whatever `distance` is then.
  struct Nearest {
    const Surfel* surfel;
    double slack;  ///< m; of none 0
  };
  Nearest nearest_of_two(const Eigen::Vector2d& p, const Eigen::Vector2d& normal,
                         double distance) const noexcept;

  const std::vector<Surfel>& surfels() const noexcept { return surfels_; }

 private:
  struct Cell {
    std::int32_t x;
    std::int32_t y;
    std::int32_t first;  ///< of the cell's surfels; or one of those below
  };
  static constexpr std::int32_t kNoCell = -1;    ///< an entry of the table that no cell has
  static constexpr std::int32_t kNoSurfel = -2;  ///< a cell that all surfels have left
  std::size_t entry_of(std::int32_t x, std::int32_t y) const noexcept;
  std::int32_t first_of(std::int32_t x, std::int32_t y) const noexcept;
  void enlist(std::int32_t surfel);
  void move(std::int32_t surfel, const Eigen::Vector2d& p);
  void rehash();
  template <typename Visit>
  void visit_facing(const Eigen::Vector2d& p, const Eigen::Vector2d& normal, const double& bound2,
                    Visit&& visit) const noexcept;
  template <typename Visit>
  void visit_near(const Eigen::Vector2d& p, double distance, Visit&& visit) const noexcept;
  std::int32_t mergeable(const Eigen::Vector2d& p, const Eigen::Vector2d& normal) const noexcept;
  void add(const Surfel& surfel);
  void merge(std::int32_t known, const Eigen::Vector2d& p, const Eigen::Vector2d& normal,
             double clock);
  void bridge(const Surfel& a, const Surfel& b, const Eigen::Vector2d& seen_from);
  void draw_lines(bool all);
  void draw_line(Surfel& surfel) const noexcept;

  // What a search reads of a surfel, and the next of the same cell; < 0: none.
  struct Entry {
    Eigen::Vector2d p;
    Eigen::Vector2d normal;
    std::int32_t next;

    bool is_surface() const noexcept { return !normal.isZero(0.0); }
  };
  std::vector<Surfel> surfels_;
  std::vector<Entry> entries_;
  std::vector<Cell> cells_;  ///< an open hash table, its size a power of two
  std::size_t used_ = 0;
  std::vector<std::int32_t> changed_;
  std::vector<char> stale_;  ///< whose line is to be drawn anew
};

}  // namespace thing_kin
