#include "thing_kin/search/covering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

namespace thing_kin {

using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

/// Discs of this share of the radius cover the plane: so far a stop surely sees.
constexpr double kCovering = 0.85;
constexpr double kTightness = 0.93;  // the pitch is that much less than discs would need
constexpr double kCellsPerRadius = 3.0;
constexpr int kMostCells = 160;            // along a side
constexpr double kDeviationsInside = 4.0;  // of the belief, in the region that is built first
constexpr double kRadiiInside = 3.0;
constexpr double kNegligible = 40.0;  // exp(-40) of a density

/// A normal density, ready to be evaluated.
struct PlanarDensity {
  explicit PlanarDensity(const PlanarNormal& normal, double floor) : mean(normal.mean) {
    const Matrix2d covariance = normal.covariance + floor * Matrix2d::Identity();
    information = covariance.inverse();
    scale = normal.weight / (2.0 * std::numbers::pi * std::sqrt(covariance.determinant()));
  }

  double operator()(const Vector2d& at) const noexcept {
    const Vector2d d = at - mean;
    const double exponent = 0.5 * d.dot(information * d);
    return exponent > kNegligible ? 0.0 : scale * std::exp(-exponent);
  }

  Vector2d mean;
  Matrix2d information;
  double scale;
};

}  // namespace

double Sight::probability(double squared_distance) const noexcept {
  if (squared_distance >= limit * limit * radius * radius) {
    return 0.0;
  }
  const double share = std::sqrt(squared_distance) / radius;
  return (1.0 - lapse) * std::min(1.0, (limit - share) / (limit - sure));
}

CoveringSearch::CoveringSearch(std::span<const PlanarNormal> belief, const Sight& sight,
                               const StopTime& time, double extent)
    : belief_(belief.begin(), belief.end()),
      sight_(sight),
      time_(time),
      most_extent_(extent),
      center_(Vector2d::Zero()) {
  double weight = 0.0;
  for (const PlanarNormal& part : belief_) {
    weight += part.weight;
    center_ += part.weight * part.mean;
  }
  center_ /= weight;
  double deviation = 0.0;
  for (PlanarNormal& part : belief_) {
    part.weight /= weight;
    deviation = std::max(
        deviation, (part.mean - center_).norm() + std::sqrt(part.covariance.diagonal().maxCoeff()));
  }
  extent_ = std::min(extent, kDeviationsInside * deviation + kRadiiInside * sight.radius);
  build();
}

void CoveringSearch::build() {
  pitch_ = std::max(sight_.radius / kCellsPerRadius, 2.0 * extent_ / kMostCells);
  cells_ = 1 + 2 * static_cast<int>(std::ceil(extent_ / pitch_));
  corner_ = center_ - 0.5 * (cells_ - 1) * pitch_ * Vector2d::Ones();
  const auto side = static_cast<std::size_t>(cells_);
  mass_.assign(side * side, 0.0);
  for (const PlanarNormal& part : belief_) {
    // A cell is as wide as its middle is exact.
    const PlanarDensity density(part, pitch_ * pitch_ / 12.0);
    for (std::size_t i = 0, k = 0; i < side; ++i) {
      for (std::size_t j = 0; j < side; ++j, ++k) {
        const Vector2d cell(static_cast<double>(i), static_cast<double>(j));
        mass_[k] += density(corner_ + pitch_ * cell) * pitch_ * pitch_;
      }
    }
  }
  remaining_ = 0.0;
  for (const double mass : mass_) {
    remaining_ += mass;
  }
  candidates_.clear();
  const double lattice = std::numbers::sqrt3 * kCovering * kTightness * sight_.radius;
  const double row = 0.5 * std::numbers::sqrt3 * lattice;
  const int rows = static_cast<int>(std::ceil(extent_ / row));
  const int columns = static_cast<int>(std::ceil(extent_ / lattice)) + 1;
  // A lattice point, and the two holes that belong to it.
  const std::array offsets{Vector2d(0.0, 0.0), Vector2d(0.5 * lattice, row / 3.0),
                           Vector2d(0.5 * lattice, -row / 3.0)};
  for (int i = -rows; i <= rows; ++i) {
    for (int j = -columns; j <= columns; ++j) {
      const Vector2d point(lattice * (j + (i % 2 != 0 ? 0.5 : 0.0)), row * i);
      for (const Vector2d& offset : offsets) {
        const Vector2d at = point + offset;
        if (at.norm() <= extent_) {
          candidates_.push_back({.at = center_ + at});
        }
      }
    }
  }
  const SearchPoints misses = std::move(misses_);
  misses_.clear();
  for (const Vector2d& at : misses) {
    misses_.push_back(at);
    take_away(at);
  }
  for (Candidate& candidate : candidates_) {
    candidate.gain = gain(candidate.at);
  }
}

bool CoveringSearch::grow() {
  if (extent_ >= most_extent_) {
    return false;
  }
  extent_ = std::min(most_extent_, 2.0 * extent_);
  build();
  return true;
}

template <typename Visit>
void CoveringSearch::visit_seen(const Vector2d& at, const Visit& visit) const {
  const double reach = sight_.limit * sight_.radius;
  const Vector2d middle = (at - corner_) / pitch_;
  const auto first = [&](double x) { return std::max(0, static_cast<int>(std::ceil(x))); };
  const auto last = [&](double x) { return std::min(cells_ - 1, static_cast<int>(std::floor(x))); };
  const double cells = reach / pitch_;
  if (!(middle.array().abs() < 1e6).all()) {
    return;
  }
  for (int i = first(middle.x() - cells); i <= last(middle.x() + cells); ++i) {
    for (int j = first(middle.y() - cells); j <= last(middle.y() + cells); ++j) {
      const Vector2d cell = corner_ + pitch_ * Vector2d(i, j);
      const double seen = sight_.probability((cell - at).squaredNorm());
      if (seen > 0.0) {
        visit(static_cast<std::size_t>(i) * static_cast<std::size_t>(cells_) +
                  static_cast<std::size_t>(j),
              cell, seen);
      }
    }
  }
}

void CoveringSearch::take_away(const Vector2d& at) {
  visit_seen(at, [&](std::size_t k, const Vector2d& /*cell*/, double seen) {
    remaining_ -= seen * mass_[k];
    mass_[k] -= seen * mass_[k];
  });
}

void CoveringSearch::miss(const Vector2d& at) {
  misses_.push_back(at);
  take_away(at);
  const double near = 2.0 * sight_.limit * sight_.radius;
  for (Candidate& candidate : candidates_) {
    if ((candidate.at - at).squaredNorm() < near * near) {
      candidate.gain = gain(candidate.at);
    }
  }
}

double CoveringSearch::gain(const Vector2d& at) const noexcept {
  double gain = 0.0;
  visit_seen(
      at, [&](std::size_t k, const Vector2d& /*cell*/, double seen) { gain += seen * mass_[k]; });
  return gain;
}

PlanarNormal CoveringSearch::seen_from(const Vector2d& at) const noexcept {
  // On a grid of its own: what the stops say does not end where the belief does.
  constexpr int kHalf = 6;
  PlanarNormal seen{.weight = 0.0};
  Matrix2d second = Matrix2d::Zero();
  for (int i = -kHalf; i <= kHalf; ++i) {
    for (int j = -kHalf; j <= kHalf; ++j) {
      const Vector2d offset = sight_.limit * sight_.radius / kHalf * Vector2d(i, j);
      double weight = sight_.probability(offset.squaredNorm());
      for (const Vector2d& miss : misses_) {
        weight *= 1.0 - sight_.probability((at + offset - miss).squaredNorm());
      }
      seen.weight += weight;
      seen.mean += weight * offset;
      second += weight * offset * offset.transpose();
    }
  }
  seen.mean /= seen.weight;
  seen.covariance = second / seen.weight - seen.mean * seen.mean.transpose();
  seen.mean += at;
  return seen;
}

bool CoveringWindow::allows(const Vector2d& point, double time) const noexcept {
  if (time > deadline || (point - reach_center - velocity * time).norm() > reach_radius) {
    return false;
  }
  bool inside = within.empty();
  for (std::size_t i = 0; i < within.size(); ++i) {
    const Vector2d& a = within[i];
    const Vector2d& b = within[(i + 1) % within.size()];
    // A ray along +x crosses this edge.
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
      inside = !inside;
    }
  }
  return inside;
}

CoveringPlan plan_covering(std::span<const PlanarNormal> belief, const Sight& sight,
                           const StopTime& time, double extent, const CoveringWindow& window,
                           double least, std::size_t count) {
  CoveringSearch search(belief, sight, time, extent);
  CoveringPlan plan;
  double now = 0.0;
  double found = 0.0;
  // The first stop is where most is found, whatever the way there.
  Vector2d at = Vector2d::Zero();
  bool first = true;
  while (plan.points.size() < count) {
    const auto arrival = [&](const Vector2d& point) {
      return first ? 0.0 : now + time((point - at).norm());
    };
    const auto allowed = [&](const Vector2d& point) {
      return window.allows(point, arrival(point));
    };
    Vector2d next;
    if (first ? !search.richest(allowed, next) : !search.next(at, least, allowed, next)) {
      break;
    }
    now = arrival(next);
    at = next;
    first = false;
    found += search.gain(at);
    search.miss(at);
    plan.points.push_back(at);
    plan.times.push_back(now);
    plan.found.push_back(found);
  }
  return plan;
}

}  // namespace thing_kin
