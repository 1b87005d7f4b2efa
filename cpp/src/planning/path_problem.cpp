#include "thing_kin/planning/path_problem.hpp"

#include <cmath>
#include <utility>
#include <variant>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

PathProblem::PathProblem(const Chain& chain, int frame, std::vector<Obstacle> obstacles,
                         LinkSpheres spheres)
    : max_joint_step(JointVector::Constant(chain.dof(), kUnlimited)),
      joint_weights(JointVector::Ones(chain.dof())),
      column_weights(JointVector::Ones(chain.dof())),
      chain_(&chain),
      frame_(frame),
      obstacles_(std::move(obstacles)),
      spheres_(std::move(spheres)),
      clearances_(chain, spheres_, obstacles_) {
  if (chain.dof() < 6) {
    throw InvalidArgument("robot", std::to_string(chain.dof()).append(" joints"),
                          "at least 6, which a pose takes");
  }
  for (const LinkSphere& sphere : spheres_.spheres) {
    const auto index = static_cast<std::size_t>(chain.frame_index(sphere.frame));
    const Chain::Frame& on = chain.frames()[index];
    centers_.push_back({on.joints, on.offset * sphere.center});
  }
  for (const Obstacle& obstacle : obstacles_) {
    if (std::holds_alternative<Disc>(obstacle)) {
      subjects_.emplace_back();
      continue;
    }
    for (int i = 0; std::cmp_less(i, spheres_.spheres.size()); ++i) {
      subjects_.push_back({i, -1});
    }
  }
  for (const auto& [first, second] : spheres_.pairs) {
    subjects_.push_back({first, second});
  }
}

// Bound on the distance of the sphere's center from any axis that turns it.
double PathProblem::turning_radius(int sphere, const double* q, const double* dq) const noexcept {
  const auto& [joint_count, point] = centers_[static_cast<std::size_t>(sphere)];
  double radius = point.norm();
  bool turned = false;
  const auto joints = chain_->joints();
  for (std::size_t i = 0; std::cmp_less(i, joint_count); ++i) {
    const int j = joints[i].index;
    if (turned) {
      radius += joints[i].fixed.translation.norm();
      if (!is_rotary(joints[i].type)) {
        radius += std::max(std::abs(q[j]), std::abs(q[j] + dq[j]));
      }
    }
    turned = turned || is_rotary(joints[i].type);
  }
  return radius;
}

double PathProblem::curvature_bound(int i, const double* q, const double* dq) const noexcept {
  const Subject& subject = subjects_[static_cast<std::size_t>(i)];
  double bound = 0.0;
  for (const int sphere : {subject.first, subject.second}) {
    if (sphere < 0) {
      continue;  // the base's reference point goes straight
    }
    const int count = centers_[static_cast<std::size_t>(sphere)].joints;
    double turning = 0.0;
    double sliding = 0.0;
    const auto joints = chain_->joints();
    for (std::size_t k = 0; std::cmp_less(k, count); ++k) {
      const double way = std::abs(dq[joints[k].index]);
      if (is_rotary(joints[k].type)) {
        turning += way;
      } else if (turning > 0.0) {
        sliding += way;
      }
    }
    bound += turning * (turning * turning_radius(sphere, q, dq) + 2.0 * sliding);
  }
  return bound;
}

double PathProblem::motion_bound(int i, const double* q, const double* dq) const noexcept {
  const Subject& subject = subjects_[static_cast<std::size_t>(i)];
  if (subject.first < 0) {
    const auto& base = *chain_->base_joints();
    return std::hypot(dq[base[0]], dq[base[1]]);
  }
  double bound = 0.0;
  for (const int sphere : {subject.first, subject.second}) {
    if (sphere < 0) {
      continue;
    }
    const double radius = turning_radius(sphere, q, dq);
    const int count = centers_[static_cast<std::size_t>(sphere)].joints;
    const auto joints = chain_->joints();
    for (std::size_t k = 0; std::cmp_less(k, count); ++k) {
      const double way = std::abs(dq[joints[k].index]);
      bound += is_rotary(joints[k].type) ? way * radius : way;
    }
  }
  return bound;
}

}  // namespace thing_kin
