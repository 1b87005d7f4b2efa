#include "thing_kin/estimation/measurement_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

constexpr std::array<int, 1> kBearing{1};

class Components final : public MeasurementModel {
 public:
  Components(const std::vector<int>& indices, const std::vector<int>& angles)
      : MeasurementModel("components", static_cast<int>(indices.size()), most_of(indices) + 1,
                         AngleSet(angles, static_cast<int>(indices.size()))),
        indices_(indices) {}

  void evaluate(const double* x, double* z) const noexcept override {
    for (const int index : indices_) {
      *z++ = x[index];
    }
  }

  void jacobian(const double* /*x*/, int n, double* H) const noexcept override {
    std::fill_n(H, rows() * n, 0.0);
    for (const int index : indices_) {
      H[index] = 1.0;
      H += n;
    }
  }

 private:
  static int most_of(const std::vector<int>& indices) {
    const bool fit = std::ranges::all_of(indices, [](int i) { return i >= 0 && i < kMaxState; });
    if (indices.empty() || indices.size() > static_cast<std::size_t>(kMaxState) || !fit) {
      throw InvalidArgument("indices", "none, too many or one out of range",
                            "1 to 16 indices of the state, from 0 to 15");
    }
    return *std::ranges::max_element(indices);
  }

  std::vector<int> indices_;
};

class RangeBearing final : public MeasurementModel {
 public:
  explicit RangeBearing(const Eigen::Vector2d& landmark)
      : MeasurementModel("range_bearing", 2, 3, AngleSet(kBearing, 2)), landmark_(landmark) {
    if (!landmark.allFinite()) {
      throw InvalidArgument("landmark", "NaN or infinity", "finite numbers");
    }
  }

  void evaluate(const double* x, double* z) const noexcept override {
    const double dx = landmark_.x() - x[0];
    const double dy = landmark_.y() - x[1];
    z[0] = std::hypot(dx, dy);
    z[1] = std::atan2(dy, dx) - x[2];
  }

  // At the landmark itself neither derivative exists: zero there.
  void jacobian(const double* x, int n, double* H) const noexcept override {
    const double dx = landmark_.x() - x[0];
    const double dy = landmark_.y() - x[1];
    const double distance = std::hypot(dx, dy);
    const double inverse = distance > 0.0 ? 1.0 / distance : 0.0;
    std::fill_n(H, 2 * n, 0.0);
    H[0] = -dx * inverse;
    H[1] = -dy * inverse;
    H[n] = dy * inverse * inverse;
    H[n + 1] = -dx * inverse * inverse;
    H[n + 2] = -1.0;
  }

 private:
  Eigen::Vector2d landmark_;
};

}  // namespace

MeasurementModel::MeasurementModel(std::string name, int rows, int least_size,
                                   const AngleSet& angles)
    : name_(std::move(name)), rows_(rows), least_size_(least_size), angles_(angles) {}

MeasurementModelPtr components(const std::vector<int>& indices, const std::vector<int>& angles) {
  return std::make_shared<Components>(indices, angles);
}

MeasurementModelPtr range_bearing(const Eigen::Vector2d& landmark) {
  return std::make_shared<RangeBearing>(landmark);
}

}  // namespace thing_kin
