#include "thing_kin/search/stochastic.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/spd.hpp"

namespace thing_kin {

namespace {

/// A cell of the grid and how improbable it is.
struct Cell {
  double i = 0.0, j = 0.0;  // whole numbers; as doubles they may be large
  double distance = 0.0;    // Mahalanobis, squared

  bool same(const Cell& other) const noexcept { return i == other.i && j == other.j; }
  bool before(const Cell& other) const noexcept {
    const auto key = [](const Cell& c) { return std::array{c.distance, c.i, c.j}; };
    return key(*this) < key(other);
  }
};

/// A factor of a covariance that may be singular, and the squared distance that it defines: along
/// what does not vary there is only the center.
class PlanarGaussian {
 public:
  explicit PlanarGaussian(const Eigen::Matrix2d& covariance) {
    a_ = std::sqrt(covariance(0, 0));
    b_ = a_ > 0.0 ? covariance(1, 0) / a_ : 0.0;
    c_ = std::sqrt(std::max(0.0, covariance(1, 1) - b_ * b_));
  }

  Eigen::Vector2d draw(RandomStream& random) const noexcept {
    const double first = random.normal();
    return {a_ * first, b_ * first + c_ * random.normal()};
  }

  double squared(double x, double y) const noexcept {
    const double first = a_ > 0.0 ? x / a_ : 0.0;
    const double second = c_ > 0.0 ? (y - b_ * first) / c_ : 0.0;
    return first * first + second * second;
  }

 private:
  double a_, b_, c_;
};

void check_stochastic(const Eigen::Vector2d& center, const Eigen::Matrix2d& covariance,
                      const StochasticOptions& options) {
  if (!center.allFinite()) {
    throw InvalidArgument("center", "NaN or inf", "finite numbers");
  }
  check_covariance(covariance, 2, "covariance");
  if (!(options.sample_gap > 0.0 && std::isfinite(options.sample_gap))) {
    throw InvalidArgument("sample_gap", text(options.sample_gap), "a positive number of metres");
  }
  const auto in_range = [](std::size_t value) { return value >= 1 && value <= kMostSearchPoints; };
  if (!in_range(options.count)) {
    throw InvalidArgument("count", std::to_string(options.count), "1 to 1000000");
  }
  if (!in_range(options.keep)) {
    throw InvalidArgument("keep", std::to_string(options.keep), "1 to 1000000");
  }
}

}  // namespace

SearchPoints stochastic_points(const Eigen::Vector2d& center, const Eigen::Matrix2d& covariance,
                               const StochasticOptions& options, RandomStream& random) {
  check_stochastic(center, covariance, options);
  const PlanarGaussian gaussian(covariance);
  const double gap = options.sample_gap;
  std::vector<Cell> cells(options.count);
  for (Cell& cell : cells) {
    const Eigen::Vector2d at = gaussian.draw(random);
    // + 0.0 makes -0 the same cell as 0.
    cell.i = std::nearbyint(at.x() / gap) + 0.0;
    cell.j = std::nearbyint(at.y() / gap) + 0.0;
    cell.distance = gaussian.squared(cell.i * gap, cell.j * gap);
  }
  cells.emplace_back();
  std::ranges::sort(cells, [](const Cell& a, const Cell& b) { return a.before(b); });
  const auto rest =
      std::ranges::unique(cells, [](const Cell& a, const Cell& b) { return a.same(b); });
  cells.erase(rest.begin(), rest.end());
  SearchPoints points{center};
  for (const Cell& cell : cells) {
    if (points.size() >= options.keep) {
      break;
    }
    if (cell.i != 0.0 || cell.j != 0.0) {
      points.emplace_back(center + gap * Eigen::Vector2d(cell.i, cell.j));
    }
  }
  return points;
}

}  // namespace thing_kin
