#include "thing_kin/planning/path_problem.hpp"

#include <algorithm>
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
  for (const Subject& subject : subjects_) {
    add_levers(subject);
  }
}

// How far each joint can move what a clearance is about, m/rad and m/m, in the order of the chain.
void PathProblem::add_levers(const Subject& subject) {
  const auto joints = chain_->joints();
  std::vector<double> levers(joints.size(), 0.0);
  if (subject.first < 0) {
    levers[0] = levers[1] = 1.0;  // x and y are the first joints of a base
  } else {
    // A turn inside of both spheres' joints leaves their distance alone.
    const Center& one = centers_[static_cast<std::size_t>(subject.first)];
    const Center* outer = &one;
    int from = 0;
    if (subject.second >= 0) {
      const Center& other = centers_[static_cast<std::size_t>(subject.second)];
      outer = other.joints > one.joints ? &other : &one;
      from = std::min(one.joints, other.joints);
    }
    double radius = outer->point.norm();
    for (int k = outer->joints - 1; k >= from; --k) {
      const auto i = static_cast<std::size_t>(k);
      levers[i] = is_rotary(joints[i].type) ? radius : 1.0;
      radius += joints[i].fixed.translation.norm();
    }
  }
  levers_.insert(levers_.end(), levers.begin(), levers.end());
}

// Sliding joints make the arms of those inside of them longer.
double PathProblem::slides(const double* q, const double* dq) const noexcept {
  double length = 0.0;
  bool turned = false;
  for (const Chain::Joint& joint : chain_->joints()) {
    if (is_rotary(joint.type)) {
      turned = true;
    } else if (turned) {
      length += std::max(std::abs(q[joint.index]), std::abs(q[joint.index] + dq[joint.index]));
    }
  }
  return length;
}

// For joint a inside of b, the point's second derivative is w_a x v_b, and zero if a slides.
double PathProblem::curvature_bound(int i, const double* q, const double* dq) const noexcept {
  if (subjects_[static_cast<std::size_t>(i)].first < 0) {
    return 0.0;  // the base's reference point goes straight
  }
  const auto joints = chain_->joints();
  const double* levers = levers_.data() + static_cast<std::size_t>(i) * joints.size();
  const double longer = slides(q, dq);
  double bound = 0.0;
  double turning = 0.0;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    if (levers[k] == 0.0) {
      continue;
    }
    const double way = std::abs(dq[joints[k].index]);
    if (is_rotary(joints[k].type)) {
      bound += way * (levers[k] + longer) * (2.0 * turning + way);
      turning += way;
    } else {
      bound += 2.0 * turning * way;
    }
  }
  return bound;
}

double PathProblem::motion_bound(int i, const double* q, const double* dq) const noexcept {
  const auto joints = chain_->joints();
  const double* levers = levers_.data() + static_cast<std::size_t>(i) * joints.size();
  const double longer = slides(q, dq);
  double bound = 0.0;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const bool turns = levers[k] > 0.0 && is_rotary(joints[k].type);
    bound += std::abs(dq[joints[k].index]) * (levers[k] + (turns ? longer : 0.0));
  }
  return bound;
}

}  // namespace thing_kin
