#include "thing_kin/model/ur_calibration.hpp"

#include <cmath>
#include <numbers>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

void check_range(const Eigen::Vector3d& values, double largest, const char* link,
                 const char* expected) {
  for (const double value : values) {
    if (!(std::abs(value) <= largest)) {
      throw InvalidArgument("calibration", text(value).append(" in ").append(quoted(link)),
                            expected);
    }
  }
}

}  // namespace

void check(const UrCalibration& calibration) {
  constexpr double kLongest = 10.0;
  constexpr double kTurn = 2 * std::numbers::pi;
  for (std::size_t i = 0; i < calibration.origins.size(); ++i) {
    const char* const link = UrCalibration::kLinks[i];
    check_range(calibration.origins[i].xyz, kLongest, link, "meters, at most 10");
    check_range(calibration.origins[i].rpy, kTurn, link, "radians, at most 2 pi");
  }
}

}  // namespace thing_kin
