#include "thing_kin/inverse/reach.hpp"

#include <algorithm>
#include <cmath>

#include "thing_kin/core/tolerance.hpp"

namespace thing_kin {

Reach::Reach(const Chain& chain, int frame) noexcept {
  const Chain::Frame& end = chain.frames()[static_cast<std::size_t>(frame)];
  const auto joints = chain.joints().first(static_cast<std::size_t>(end.joints));
  SE3 at;  // of the joint at hand, with the slides at zero
  std::size_t k = 0;
  for (; k < joints.size(); ++k) {
    at = at * joints[k].fixed;
    const Eigen::Vector3d axis = at.rotation.col(2);
    const bool orthogonal = std::all_of(
        slides_.begin(), slides_.begin() + count_,
        [&](const Slide& s) { return std::abs(s.axis.dot(axis)) < kRightAngleTolerance; });
    if (joints[k].type != JointType::kPrismatic || count_ == slides_.size() || !orthogonal) {
      break;
    }
    slides_[count_++] = {axis, joints[k].index};
  }
  origin_ = k < joints.size() ? at.translation : (at * end.offset).translation;
  for (; k < joints.size(); ++k) {
    if (joints[k].type == JointType::kPrismatic) {
      const Eigen::Index j = joints[k].index;
      radius_ += std::max(std::abs(chain.lower()[j]), std::abs(chain.upper()[j]));
    }
    length_ += k + 1 < joints.size() ? joints[k + 1].fixed.translation.norm()
                                     : end.offset.translation.norm();
  }
  radius_ += length_;
}

double Reach::beyond(const JointBox& box, const Eigen::Vector3d& point) const noexcept {
  Eigen::Vector3d way = point - origin_;
  for (std::size_t i = 0; i < count_; ++i) {
    const auto& [axis, j] = slides_[i];
    way -= std::clamp(axis.dot(way), box.lower(j), box.upper(j)) * axis;
  }
  const double slack = 1e-9 * (radius_ + way.norm());
  return std::max(0.0, way.norm() - radius_ - slack);
}

void Reach::drive(const JointBox& box, double rest, Eigen::Vector3d& way,
                  double* q) const noexcept {
  const double distance = way.norm();
  if (distance <= rest) {
    return;
  }
  const double part = (distance - rest) / distance;
  for (std::size_t i = 0; i < count_; ++i) {
    const auto& [axis, j] = slides_[i];
    const double x = std::clamp(q[j] + part * axis.dot(way), box.lower(j), box.upper(j));
    way -= (x - q[j]) * axis;
    q[j] = x;
  }
}

}  // namespace thing_kin
