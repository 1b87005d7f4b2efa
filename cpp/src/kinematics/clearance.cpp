#include "thing_kin/kinematics/clearance.hpp"

#include <utility>

#include <Eigen/Geometry>

#include "kernels/arguments.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

using Axis = Eigen::Map<const Eigen::Vector3d>;

/// The rate of a point by joint k, [M17] (3.12), (3.13).
Eigen::Vector3d column(const Skeleton& skeleton, const Posture& posture, int k,
                       const Eigen::Vector3d& point) noexcept {
  const Axis z(posture.columns + 16 * k + 8);
  const Axis origin(posture.columns + 16 * k + 12);
  if (skeleton.step[k].prismatic) {
    return z;
  }
  return z.cross(point - origin);
}

bool is_disc(const Obstacle& obstacle) { return std::holds_alternative<Disc>(obstacle); }

std::string numbered(std::size_t i) {
  return std::string("obstacles[").append(std::to_string(i)).append("]");
}

void check_obstacle(const Chain& chain, const Obstacle& obstacle, std::size_t i) {
  if (is_disc(obstacle) && !chain.base_joints()) {
    throw InvalidArgument(numbered(i), "a Disc for " + quoted(chain.name()) + ", which has no base",
                          "a Sphere, Capsule, Box or HalfSpace");
  }
  check(obstacle, numbered(i).append("."));
}

}  // namespace

Clearances::Clearances(const Chain& chain, const LinkSpheres& spheres,
                       std::vector<Obstacle> obstacles)
    : chain_(chain), obstacles_(std::move(obstacles)) {
  check(chain, spheres);
  for (const auto& [name, center, radius] : spheres.spheres) {
    const SkeletonFrame frame = skeleton_frame_at(chain, {chain.frame_index(name), center});
    balls_.push_back({name, frame.joints, Axis(frame.offset + 12), radius});
  }
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    check_obstacle(chain, obstacles_[i], i);
    const bool disc = is_disc(obstacles_[i]);
    const int end = disc ? 0 : static_cast<int>(balls_.size());
    for (int moving = disc ? -1 : 0; moving < end; ++moving) {
      rows_.push_back({moving, -1, static_cast<int>(i)});
    }
  }
  for (const auto& [one, other] : spheres.pairs) {
    const bool in_order = balls_[static_cast<std::size_t>(one)].joints <=
                          balls_[static_cast<std::size_t>(other)].joints;
    rows_.push_back({in_order ? other : one, in_order ? one : other, -1});
  }
}

Eigen::Vector3d Clearances::center_of(const Ball& ball, const Posture& posture) const noexcept {
  if (ball.joints == 0) {
    return ball.point;
  }
  const Eigen::Map<const Eigen::Matrix4d> moved(posture.columns + 16 * (ball.joints - 1));
  return moved.topLeftCorner<3, 3>() * ball.point + moved.topRightCorner<3, 1>();
}

double Clearances::value(const Posture& posture, const double* q, int i) const noexcept {
  const Row& row = rows_[static_cast<std::size_t>(i)];
  if (row.outer < 0) {
    const auto& base = *chain_.base_joints();
    return signed_distance_value(obstacle(row), {q[base[0]], q[base[1]], 0.0});
  }
  const Ball& outer = ball(row.outer);
  const Eigen::Vector3d point = center_of(outer, posture);
  if (row.obstacle >= 0) {
    return signed_distance_value(obstacle(row), point) - outer.radius;
  }
  const Ball& inner = ball(row.inner);
  return (point - center_of(inner, posture)).norm() - inner.radius - outer.radius;
}

Clearances::Measured Clearances::measure(const Posture& posture, const double* q,
                                         const Row& row) const noexcept {
  if (row.outer < 0) {  // its slides are the chain's first two joints
    const auto& base = *chain_.base_joints();
    const Eigen::Vector3d point(q[base[0]], q[base[1]], 0.0);
    return {point, signed_distance(obstacle(row), point), 0, 2};
  }
  const Ball& outer = ball(row.outer);
  Measured measured{center_of(outer, posture), {}, 0, outer.joints};
  if (row.obstacle >= 0) {
    measured.distance = signed_distance(obstacle(row), measured.point);
  } else {
    const Ball& inner = ball(row.inner);
    measured.first = inner.joints;
    measured.distance =
        signed_distance(Sphere{center_of(inner, posture), inner.radius}, measured.point);
  }
  measured.distance.value -= outer.radius;
  return measured;
}

double Clearances::gradient(const Posture& posture, const double* q, int i,
                            JointVector& gradient) const noexcept {
  const Measured measured = measure(posture, q, rows_[static_cast<std::size_t>(i)]);
  const Skeleton& skeleton = chain_.skeleton();
  gradient.setZero(chain_.dof());
  for (int k = measured.first; k < measured.end; ++k) {
    gradient[skeleton.step[k].index] =
        measured.distance.gradient.dot(column(skeleton, posture, k, measured.point));
  }
  return measured.distance.value;
}

// J^T D J + g . d^2p, where d^2p/dq_k dq_m = w_k x J_m for k no further from the root than m.
void Clearances::add_hessian(const Posture& posture, const double* q, int i, double weight,
                             SmallMatrix& H) const noexcept {
  const Measured measured = measure(posture, q, rows_[static_cast<std::size_t>(i)]);
  const Skeleton& skeleton = chain_.skeleton();
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxDof> J(3, measured.end);
  const Eigen::Vector3d g = weight * measured.distance.gradient;
  for (int m = measured.first; m < measured.end; ++m) {
    J.col(m) = column(skeleton, posture, m, measured.point);
    const Eigen::Vector3d bent = weight * (measured.distance.hessian * J.col(m));
    const Eigen::Vector3d turned = J.col(m).cross(g);  // w . (J_m x g) = g . (w x J_m)
    for (int k = measured.first; k <= m; ++k) {
      double second = J.col(k).dot(bent);
      if (!skeleton.step[k].prismatic) {
        second += Axis(posture.columns + 16 * k + 8).dot(turned);
      }
      H(skeleton.step[k].index, skeleton.step[m].index) += second;
      if (k != m) {
        H(skeleton.step[m].index, skeleton.step[k].index) += second;
      }
    }
  }
}

std::string Clearances::describe(int i) const {
  const Row& row = rows_[static_cast<std::size_t>(i)];
  const auto sphere = [&](int index) {
    return std::to_string(index).append(" (").append(ball(index).frame).append(")");
  };
  if (row.obstacle < 0) {
    const auto& [first, second] = std::minmax(row.inner, row.outer);
    return "spheres " + sphere(first) + " and " + sphere(second);
  }
  const std::string obstacle = "obstacle " + std::to_string(row.obstacle);
  return (row.outer < 0 ? std::string("the base") : "sphere " + sphere(row.outer)) + " and " +
         obstacle;
}

}  // namespace thing_kin
