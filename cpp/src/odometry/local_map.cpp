#include "thing_kin/odometry/local_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace thing_kin {

namespace {

using Eigen::Vector2d;

// Side of a cell, m.
constexpr double kCell = 0.2;
// A surfel is the mean of its points until there are so many; then the mean goes with the latest.
constexpr double kMostPoints = 20.0;
// Cosines: normals of one surfel; of a point and the surface that it may lie on; of the surfels
// that share a line.
constexpr double kSameSurface = 0.7;
constexpr double kSameSide = 0.5;
constexpr double kSameLine = 0.8;
// A line is a mean over this radius, in m, where weights fall to zero.
constexpr double kLineRadius = 0.25;
// Points of one wall further apart, in m, are bridged by surfels at most so far apart; over so many
// beams and so much of a way at most. Sines and cosines: of the way to both normals, to the beam.
constexpr double kBridge = 0.2;
constexpr double kLongestBridge = 1.0;
constexpr double kBridgeSlope = 0.2;
constexpr double kBridgeGraze = 0.87;
constexpr int kNeighborBeams = 2;
// m; a pair is kept for so much at most, as looking further costs.
constexpr double kMostSlack = 0.02;
// In that mean one surfel counts as so many points at most.
constexpr double kMostShare = 5.0;

// The floor, without a call of the library's.
std::int32_t cell_of(double v) noexcept {
  const double cells = v * (1.0 / kCell);
  const auto cell = static_cast<std::int32_t>(cells);
  return cell - (cells < cell ? 1 : 0);
}

// From a place in a cell, seen from its lower end, to the cells so many further.
double squared_gap(std::int32_t further, double inside) noexcept {
  const double gap = further > 0 ? further * kCell - inside : inside - (further + 1) * kCell;
  return further == 0 ? 0.0 : gap * gap;
}

}  // namespace

std::size_t LocalMap::entry_of(std::int32_t x, std::int32_t y) const noexcept {
  const std::uint64_t key = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32U) |
                            static_cast<std::uint32_t>(y);
  std::uint64_t hash = key * 0x9E3779B97F4A7C15ULL;
  hash ^= hash >> 32U;
  std::size_t entry = hash & (cells_.size() - 1);
  while (cells_[entry].first != kNoCell && (cells_[entry].x != x || cells_[entry].y != y)) {
    entry = (entry + 1) & (cells_.size() - 1);
  }
  return entry;
}

std::int32_t LocalMap::first_of(std::int32_t x, std::int32_t y) const noexcept {
  return cells_[entry_of(x, y)].first;
}

void LocalMap::enlist(std::int32_t surfel) {
  if (2 * (used_ + 1) > cells_.size()) {
    rehash();
    return;
  }
  const Vector2d& p = surfels_[static_cast<std::size_t>(surfel)].p;
  const std::int32_t x = cell_of(p.x());
  const std::int32_t y = cell_of(p.y());
  Cell& cell = cells_[entry_of(x, y)];
  used_ += cell.first == kNoCell ? 1 : 0;
  entries_[static_cast<std::size_t>(surfel)].next = cell.first;
  cell = {.x = x, .y = y, .first = surfel};
}

// A surfel's mean goes there, with it from one cell's list to another's.
void LocalMap::move(std::int32_t surfel, const Vector2d& p) {
  Entry& entry = entries_[static_cast<std::size_t>(surfel)];
  const Vector2d before = entry.p;
  surfels_[static_cast<std::size_t>(surfel)].p = p;
  entry.p = p;
  if (cell_of(before.x()) == cell_of(p.x()) && cell_of(before.y()) == cell_of(p.y())) {
    return;
  }
  Cell& cell = cells_[entry_of(cell_of(before.x()), cell_of(before.y()))];
  if (cell.first == surfel) {
    cell.first = entry.next < 0 ? kNoSurfel : entry.next;
  } else {
    std::int32_t k = cell.first;
    while (entries_[static_cast<std::size_t>(k)].next != surfel) {
      k = entries_[static_cast<std::size_t>(k)].next;
    }
    entries_[static_cast<std::size_t>(k)].next = entry.next;
  }
  enlist(surfel);
}

// All surfels anew, in a table at most a quarter full.
void LocalMap::rehash() {
  std::size_t size = 1024;
  while (size < 4 * (surfels_.size() + 1)) {
    size *= 2;
  }
  cells_.assign(size, Cell{.x = 0, .y = 0, .first = kNoCell});
  used_ = 0;
  entries_.clear();
  for (const Surfel& surfel : surfels_) {
    entries_.push_back({.p = surfel.p, .normal = surfel.normal, .next = -1});
  }
  for (std::size_t k = 0; k < surfels_.size(); ++k) {
    enlist(static_cast<std::int32_t>(k));
  }
}

template <typename Visit>
void LocalMap::visit_near(const Vector2d& p, double distance, Visit&& visit) const noexcept {
  if (surfels_.empty()) {
    return;
  }
  const std::int32_t x_last = cell_of(p.x() + distance);
  const std::int32_t y_first = cell_of(p.y() - distance);
  const std::int32_t y_last = cell_of(p.y() + distance);
  for (std::int32_t x = cell_of(p.x() - distance); x <= x_last; ++x) {
    for (std::int32_t y = y_first; y <= y_last; ++y) {
      for (std::int32_t k = first_of(x, y); k >= 0;) {
        const Entry& entry = entries_[static_cast<std::size_t>(k)];
        visit(k, entry, (entry.p - p).squaredNorm());
        k = entry.next;
      }
    }
  }
}

std::int32_t LocalMap::mergeable(const Vector2d& p, const Vector2d& normal) const noexcept {
  const bool surface = !normal.isZero(0.0);
  std::int32_t found = -1;
  double least = kMergeDistance * kMergeDistance;
  visit_near(p, kMergeDistance, [&](std::int32_t k, const Entry& entry, double distance2) {
    if (distance2 < least && entry.is_surface() == surface &&
        (!surface || entry.normal.dot(normal) >= kSameSurface)) {
      least = distance2;
      found = k;
    }
  });
  return found;
}

void LocalMap::add(const Surfel& surfel) {
  surfels_.push_back(surfel);
  entries_.push_back({.p = surfel.p, .normal = surfel.normal, .next = -1});
  const auto k = static_cast<std::int32_t>(surfels_.size()) - 1;
  enlist(k);
  changed_.push_back(k);
}

void LocalMap::merge(std::int32_t known, const Vector2d& p, const Vector2d& normal, double clock) {
  Surfel& surfel = surfels_[static_cast<std::size_t>(known)];
  const double weight = std::min(surfel.weight, kMostPoints);
  move(known, (surfel.p * weight + p) / (weight + 1.0));
  if (surfel.is_surface()) {
    surfel.normal = (surfel.normal * weight + normal).normalized();
  }
  surfel.weight = weight + 1.0;
  surfel.seen = clock;
  entries_[static_cast<std::size_t>(known)].normal = surfel.normal;
  changed_.push_back(known);
}

// Where beams fall far apart on one wall, what is between them is wall too; but not where they
// graze it, as they would miss an open door there.
void LocalMap::bridge(const Surfel& a, const Surfel& b, const Vector2d& seen_from) {
  const Vector2d way = b.p - a.p;
  const double length = way.norm();
  if (length <= kBridge || length > kLongestBridge || !a.is_surface() || !b.is_surface() ||
      a.normal.dot(b.normal) < kSameLine ||
      std::max(std::abs(way.dot(a.normal)), std::abs(way.dot(b.normal))) > kBridgeSlope * length) {
    return;
  }
  const Vector2d beam = (b.p - seen_from).normalized();
  if (std::abs(way.dot(beam)) > kBridgeGraze * length) {
    return;
  }
  const int pieces = static_cast<int>(std::ceil(length / kBridge));
  for (int k = 1; k < pieces; ++k) {
    const double share = static_cast<double>(k) / pieces;
    Surfel between = a;
    between.p = between.line_p = a.p + share * way;
    between.normal = between.line_normal =
        ((1.0 - share) * a.normal + share * b.normal).normalized();
    between.weight = 1.0 / pieces;
    if (mergeable(between.p, between.normal) < 0) {
      add(between);
    }
  }
}

void LocalMap::insert(const PlanarScan& scan, const Pose2& pose, double clock) {
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(pose.z()).toRotationMatrix();
  const bool is_new = surfels_.empty();
  Surfel last{};
  int last_beam = std::numeric_limits<int>::min() / 2;
  for (const ScanPoint& point : scan) {
    if (point.surroundings == Surroundings::kSparse) {
      continue;
    }
    const Vector2d p = R * point.p + pose.head<2>();
    const Vector2d normal = R * point.normal;
    const Surfel own{
        .p = p, .normal = normal, .weight = 1.0, .seen = clock, .line_p = p, .line_normal = normal};
    const std::int32_t known = mergeable(p, normal);
    if (known < 0) {
      add(own);
    } else {
      merge(known, p, normal, clock);
    }
    if (point.beam - last_beam <= kNeighborBeams) {
      bridge(last, own, pose.head<2>());
    }
    last = own;
    last_beam = point.beam;
  }
  draw_lines(is_new);
}

// Of all surfels, or of those whose neighborhood has changed.
void LocalMap::draw_lines(bool all) {
  if (all) {
    changed_.clear();
    for (Surfel& surfel : surfels_) {
      draw_line(surfel);
    }
    return;
  }
  stale_.reserve(surfels_.capacity());
  stale_.assign(surfels_.size(), 0);
  for (const std::int32_t k : changed_) {
    const Vector2d p = surfels_[static_cast<std::size_t>(k)].p;
    visit_near(p, kLineRadius, [&](std::int32_t other, const Entry&, double) {
      stale_[static_cast<std::size_t>(other)] = 1;
    });
  }
  changed_.clear();
  for (std::size_t k = 0; k < surfels_.size(); ++k) {
    if (stale_[k] != 0) {
      draw_line(surfels_[k]);
    }
  }
}

void LocalMap::forget(const Vector2d& center, double radius, double oldest) {
  const auto gone = std::erase_if(surfels_, [&](const Surfel& surfel) {
    return surfel.seen < oldest || (surfel.p - center).squaredNorm() > radius * radius;
  });
  if (gone > 0) {
    rehash();
  }
}

void LocalMap::clear() noexcept {
  surfels_.clear();
  entries_.clear();
  std::ranges::fill(cells_, Cell{.x = 0, .y = 0, .first = kNoCell});
  used_ = 0;
}

void LocalMap::draw_line(Surfel& surfel) const noexcept {
  surfel.line_p = surfel.p;
  surfel.line_normal = surfel.normal;
  if (!surfel.is_surface()) {
    return;
  }
  Vector2d p = Vector2d::Zero();
  Vector2d normal = Vector2d::Zero();
  double total = 0.0;
  visit_near(surfel.p, kLineRadius, [&](std::int32_t k, const Entry& other, double distance2) {
    const double u = 1.0 - distance2 / (kLineRadius * kLineRadius);
    if (u > 0.0 && other.is_surface() && other.normal.dot(surfel.normal) >= kSameLine) {
      const double weight =
          u * u * std::min(surfels_[static_cast<std::size_t>(k)].weight, kMostShare);
      const Vector2d off = other.p - surfel.p;
      p += weight * off;
      normal += weight * other.normal;
      total += weight;
    }
  });
  if (total > 0.0) {
    p /= total;
    surfel.line_p = surfel.p + p;
    surfel.line_normal = normal.normalized();
  }
}

// Surfels that a point with this normal may lie on, of the own cell first; the visitor draws the
// bound in, and cells beyond are left out.
template <typename Visit>
void LocalMap::visit_facing(const Vector2d& p, const Vector2d& normal, const double& bound2,
                            Visit&& visit) const noexcept {
  if (surfels_.empty()) {
    return;
  }
  const bool surface = !normal.isZero(0.0);
  const auto visit_cell = [&](std::int32_t x, std::int32_t y) {
    for (std::int32_t k = first_of(x, y); k >= 0;) {
      const Entry& entry = entries_[static_cast<std::size_t>(k)];
      const double distance2 = (entry.p - p).squaredNorm();
      if (distance2 < bound2 &&
          (!surface || (entry.is_surface() && entry.normal.dot(normal) >= kSameSide))) {
        visit(k, distance2);
      }
      k = entry.next;
    }
  };
  const std::int32_t x = cell_of(p.x());
  const std::int32_t y = cell_of(p.y());
  visit_cell(x, y);
  const double reach = std::sqrt(bound2);
  const Vector2d inside(p.x() - x * kCell, p.y() - y * kCell);
  const std::int32_t left = cell_of(p.x() - reach) - x;
  const std::int32_t right = cell_of(p.x() + reach) - x;
  const std::int32_t below = cell_of(p.y() - reach) - y;
  const std::int32_t above = cell_of(p.y() + reach) - y;
  for (std::int32_t column = left; column <= right; ++column) {
    const double gap_x2 = squared_gap(column, inside.x());
    for (std::int32_t row = below; row <= above; ++row) {
      if ((column != 0 || row != 0) && gap_x2 + squared_gap(row, inside.y()) < bound2) {
        visit_cell(x + column, y + row);
      }
    }
  }
}

const Surfel* LocalMap::nearest(const Vector2d& p, const Vector2d& normal,
                                double distance) const noexcept {
  std::int32_t found = -1;
  double least = distance * distance;
  visit_facing(p, normal, least, [&](std::int32_t k, double distance2) {
    least = distance2;
    found = k;
  });
  return found < 0 ? nullptr : &surfels_[static_cast<std::size_t>(found)];
}

LocalMap::Nearest LocalMap::nearest_of_two(const Vector2d& p, const Vector2d& normal,
                                           double distance) const noexcept {
  std::int32_t found = -1;
  double least = distance * distance;
  double bound = least;  // of the second, which is not asked for beyond a slack of kMostSlack
  visit_facing(p, normal, bound, [&](std::int32_t k, double distance2) {
    if (distance2 >= least) {
      bound = distance2;
      return;
    }
    const double reach = std::sqrt(distance2) + 2.0 * kMostSlack;
    bound = std::min(found < 0 ? bound : least, reach * reach);
    least = distance2;
    found = k;
  });
  if (found < 0) {
    return {.surfel = nullptr, .slack = 0.0};
  }
  return {.surfel = &surfels_[static_cast<std::size_t>(found)],
          .slack = 0.5 * (std::sqrt(bound) - std::sqrt(least))};
}

}  // namespace thing_kin
