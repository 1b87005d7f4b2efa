#include <algorithm>
#include <cmath>
#include <numbers>

#include "thing_kin/core/low_discrepancy.hpp"
#include "thing_kin/kinematics/link_spheres.hpp"
#include "thing_kin/kinematics/posture.hpp"

namespace thing_kin {

namespace {

struct Interval {
  double lower;
  double upper;
};

/// A sphere as the chain's joints see it.
struct Placed {
  int frame;
  int joints;              ///< how many move it
  Eigen::Vector3d center;  ///< in the frame
  Eigen::Vector3d moved;   ///< in what the last of the joints moves
  double radius;
};

Interval range_of(const Chain& robot, int index) {
  const bool slides = robot.joint_types()[static_cast<std::size_t>(index)] == JointType::kPrismatic;
  const double most = slides ? 1.0 : std::numbers::pi;
  const double lower = robot.lower()[index];
  const double upper = robot.upper()[index];
  if (std::isfinite(lower)) {
    return {lower, std::isfinite(upper) ? upper : lower + 2.0 * most};
  }
  return std::isfinite(upper) ? Interval{upper - 2.0 * most, upper} : Interval{-most, most};
}

std::vector<Placed> placed(const Chain& robot, const std::vector<LinkSphere>& spheres) {
  std::vector<Placed> result;
  for (const auto& [name, center, radius] : spheres) {
    const int index = robot.frame_index(name);
    const auto& frame = robot.frames()[static_cast<std::size_t>(index)];
    result.push_back({index, frame.joints, center, frame.offset * center, radius});
  }
  return result;
}

/// How far joint k's frame, after its motion, can be from `from` in the frame before it.
Interval reach_of(const Chain& robot, int k, const Eigen::Vector3d& from) {
  const Chain::Joint& joint = robot.joints()[static_cast<std::size_t>(k)];
  const Eigen::Vector3d way = joint.fixed.translation - from;
  if (joint.type != JointType::kPrismatic) {
    return {way.norm(), way.norm()};
  }
  const Interval range{robot.lower()[joint.index], robot.upper()[joint.index]};
  const Eigen::Vector3d axis = joint.fixed.rotation.col(2);
  const auto length = [&](double q) {
    return std::isfinite(q) ? (way + q * axis).norm() : std::abs(q);
  };
  const double nearest = std::clamp(-axis.dot(way), range.lower, range.upper);
  return {length(nearest), std::max(length(range.lower), length(range.upper))};
}

/// Whether two spheres can't meet: one of the lengths between them is longer than all others.
bool stay_apart(const Chain& robot, const Placed& inner, const Placed& outer) {
  double longest = 2.0 * outer.moved.norm();  // each length twice: once it is in the sum
  double sum = outer.moved.norm();
  Eigen::Vector3d from = inner.moved;
  for (int k = inner.joints; k < outer.joints; ++k) {
    const Interval length = reach_of(robot, k, from);
    longest = std::max(longest, length.lower + length.upper);
    sum += length.upper;
    from.setZero();
  }
  return std::isfinite(sum) && longest - sum > inner.radius + outer.radius;
}

bool may_meet(const Chain& robot, const Placed& one, const Placed& other) {
  const auto& [inner, outer] =
      std::minmax(one, other, [](const Placed& a, const Placed& b) { return a.joints < b.joints; });
  return outer.joints - inner.joints > 1 && !stay_apart(robot, inner, outer);
}

using Pairs = std::vector<std::pair<int, int>>;

/// Where the spheres are in posture k of many.
void place(const Chain& robot, const std::vector<Placed>& spheres, int k,
           std::vector<Eigen::Vector3d>& centers) {
  const LowDiscrepancy samples(robot.dof(), 0);
  JointVector q(robot.dof());
  for (int i = 0; i < robot.dof(); ++i) {
    const Interval range = range_of(robot, i);
    q[i] = range.lower + samples(static_cast<std::uint64_t>(k), i) * (range.upper - range.lower);
  }
  Posture posture;
  place_joints(robot, q.data(), posture);
  std::ranges::transform(spheres, centers.begin(), [&](const Placed& sphere) {
    return frame_pose(robot, posture, sphere.frame) * sphere.center;
  });
}

/// In how many of the postures each pair overlaps.
std::vector<int> overlaps(const Chain& robot, const std::vector<Placed>& spheres,
                          const Pairs& pairs, int postures) {
  std::vector<int> counts(pairs.size(), 0);
  std::vector<Eigen::Vector3d> centers(spheres.size());
  for (int k = 0; k < postures; ++k) {
    place(robot, spheres, k, centers);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto one = static_cast<std::size_t>(pairs[i].first);
      const auto other = static_cast<std::size_t>(pairs[i].second);
      const double touching = spheres[one].radius + spheres[other].radius;
      counts[i] += (centers[one] - centers[other]).norm() < touching ? 1 : 0;
    }
  }
  return counts;
}

}  // namespace

Pairs self_collision_pairs(const Chain& robot, const std::vector<LinkSphere>& spheres) {
  check(robot, LinkSpheres{spheres, {}});
  const std::vector<Placed> all = placed(robot, spheres);
  Pairs candidates;
  for (std::size_t j = 1; j < all.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      if (may_meet(robot, all[i], all[j])) {
        candidates.emplace_back(static_cast<int>(i), static_cast<int>(j));
      }
    }
  }
  constexpr int kPostures = 256;
  constexpr int kTooOften = kPostures / 4;
  const std::vector<int> counts = overlaps(robot, all, candidates, kPostures);
  Pairs pairs;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (counts[i] < kTooOften) {
      pairs.push_back(candidates[i]);
    }
  }
  return pairs;
}

}  // namespace thing_kin
