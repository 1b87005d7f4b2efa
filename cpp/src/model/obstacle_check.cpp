#include <cmath>

#include "thing_kin/core/error.hpp"
#include "thing_kin/model/obstacle.hpp"

namespace thing_kin {

namespace {

void check_finite(const std::string& argument, const Eigen::Ref<const Eigen::VectorXd>& numbers) {
  // Squares of what is larger would overflow.
  constexpr double kLargest = 1e50;
  for (const double number : numbers) {
    if (!(std::abs(number) <= kLargest)) {
      throw InvalidArgument(argument, text(number), "finite numbers up to 1e50");
    }
  }
}

void check_positive(const std::string& argument, double number) {
  check_finite(argument, Eigen::VectorXd::Constant(1, number));
  if (!(number > 0.0)) {
    throw InvalidArgument(argument, text(number), "a number > 0");
  }
}

void check_shape(const Disc& disc, const std::string& prefix) {
  check_finite(prefix + "center", disc.center);
  check_positive(prefix + "radius", disc.radius);
}

void check_shape(const Sphere& sphere, const std::string& prefix) {
  check_finite(prefix + "center", sphere.center);
  check_positive(prefix + "radius", sphere.radius);
}

void check_shape(const Capsule& capsule, const std::string& prefix) {
  check_finite(prefix + "start", capsule.start);
  check_finite(prefix + "end", capsule.end);
  check_positive(prefix + "radius", capsule.radius);
}

void check_shape(const Box& box, const std::string& prefix) {
  check_finite(prefix + "pose", box.pose.translation);
  if (!is_rigid(box.pose.matrix())) {
    throw InvalidArgument(prefix + "pose", "no rigid transform",
                          "R^T R = I within 1e-6 and det R = 1");
  }
  for (const double half : box.half_size) {
    check_positive(prefix + "size", 2.0 * half);
  }
}

void check_shape(const HalfSpace& half, const std::string& prefix) {
  check_finite(prefix + "offset", Eigen::VectorXd::Constant(1, half.offset));
  check_finite(prefix + "normal", half.normal);
  constexpr double kRounding = 1e-9;
  if (!(std::abs(half.normal.norm() - 1.0) <= kRounding)) {
    throw InvalidArgument(prefix + "normal", "length " + text(half.normal.norm()),
                          "a vector of length 1");
  }
}

}  // namespace

void check(const Obstacle& obstacle, const std::string& prefix) {
  std::visit([&](const auto& shape) { check_shape(shape, prefix); }, obstacle);
}

}  // namespace thing_kin
