#include "path_start.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include <Eigen/LU>

#include "thing_kin/kinematics/damped_inverse.hpp"
#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/kinematics/pose_error.hpp"
#include "thing_kin/linalg/row_qr.hpp"

namespace thing_kin {

namespace {

constexpr double kClear = 0.02;  // m, how far outside a disc a detour goes

// Waypoints [first, last] of a line that are inside a disc.
struct Crossing {
  Disc disc;
  std::size_t first, last;
};

std::vector<Crossing> crossings(const PathProblem& problem, const BaseLine& line) {
  std::vector<Crossing> found;
  for (const Obstacle& obstacle : problem.obstacles()) {
    const Disc* disc = std::get_if<Disc>(&obstacle);
    if (disc == nullptr) {
      continue;
    }
    for (std::size_t k = 0; k < line.size(); ++k) {
      if ((line[k] - disc->center).norm() >= disc->radius) {
        continue;
      }
      const std::size_t first = k;
      while (k + 1 < line.size() && (line[k + 1] - disc->center).norm() < disc->radius) {
        ++k;
      }
      found.push_back({*disc, first, k});
    }
  }
  return found;
}

// Moves the crossing's waypoints sideways out of its disc; returns the longest way.
double push(const Crossing& crossing, double side, BaseLine& line) {
  const std::size_t before = crossing.first > 0 ? crossing.first - 1 : 0;
  const std::size_t after = std::min(crossing.last + 1, line.size() - 1);
  Eigen::Vector2d along = line[after] - line[before];
  if (along.norm() < 1e-9) {
    along = Eigen::Vector2d::UnitX();
  }
  along.normalize();
  const Eigen::Vector2d normal(-side * along[1], side * along[0]);
  const double radius = crossing.disc.radius + kClear;
  double longest = 0.0;
  for (std::size_t k = crossing.first; k <= crossing.last; ++k) {
    const Eigen::Vector2d from_center = line[k] - crossing.disc.center;
    const double b = from_center.dot(normal);
    const double way = -b + std::sqrt(b * b + radius * radius - from_center.squaredNorm());
    line[k] += way * normal;
    longest = std::max(longest, way);
  }
  return longest;
}

// The step of the hand to its pose, and in its null space that of the base to its place.
class Follower {
 public:
  explicit Follower(const PathProblem& problem)
      : problem_(problem), n_(problem.dof()), mobility_(JointVector::Ones(problem.dof())) {
    mobility_ = problem.joint_weights.cwiseAbs2().cwiseInverse();
  }

  bool settle(const PathGoal& goal, const Eigen::Vector2d* place, JointVector& q) {
    constexpr int kIterations = 30;
    constexpr double kSettled = 1e-3;
    for (int i = 0; i < kIterations; ++i) {
      const double moved = step(goal, place, q);
      if (!std::isfinite(moved)) {
        return false;
      }
      if (moved < kSettled && error_ < kSettled) {
        break;
      }
    }
    for (int i = 0; i < kIterations; ++i) {  // the hand alone
      step(goal, nullptr, q);
      if (error_ < 1e-10) {
        return true;
      }
    }
    return false;
  }

 private:
  double step(const PathGoal& goal, const Eigen::Vector2d* place, JointVector& q) {
    constexpr double kDamping = 1e-9;
    constexpr double kLongest = 0.4;
    Posture posture;
    place_joints(problem_.chain(), q.data(), posture);
    const Vector6 e =
        pose_error(frame_pose(problem_.chain(), posture, problem_.frame()), goal.pose);
    error_ = e.norm();
    Jacobian J;
    geometric_jacobian(problem_.chain(), posture, problem_.frame(), ReferenceFrame::kWorldAligned,
                       J);
    JointVector dq(n_);
    damped_inverse(J, RowFactors{}, mobility_.data(), kDamping, e, dq.data());
    if (place != nullptr && problem_.freedom() > 0) {
      pull(goal, *place, J, q, dq);
    }
    const double longest = dq.lpNorm<Eigen::Infinity>();
    if (std::isfinite(longest)) {
      q += std::min(1.0, kLongest / longest) * dq;
    }
    return longest;
  }

  void pull(const PathGoal& goal, const Eigen::Vector2d& place, const Jacobian& J,
            const JointVector& q, JointVector& dq) {
    constexpr double kDamping = 1e-4;
    const auto& base = *problem_.chain().base_joints();
    const double theta = q[base[2]] + dq[base[2]];
    const double turned = std::clamp(theta, goal.heading_lower, goal.heading_upper);
    const int rows = turned != theta ? 3 : 2;
    SmallMatrix A = J;
    RowQr qr;
    qr.factor(A);
    SmallMatrix Z;
    qr.null_space(Z);
    SmallMatrix B(rows, Z.cols());
    SmallVector way(rows);
    for (int i = 0; i < rows; ++i) {
      const int j = base[static_cast<std::size_t>(i)];
      B.row(i) = Z.row(j);
      way[i] = (i < 2 ? place[i] : turned) - q[j] - dq[j];
    }
    SmallMatrix gram = B * B.transpose();
    gram.diagonal().array() += kDamping;
    const SmallVector y = gram.partialPivLu().solve(way);
    dq += Z * (B.transpose() * y);
  }

  const PathProblem& problem_;
  int n_;
  JointVector mobility_;
  double error_ = 0.0;
};

}  // namespace

std::vector<BaseLine> lines_past_discs(const PathProblem& problem, const BaseLine& line) {
  constexpr std::size_t kMost = 4;  // crossings with two sides each; the others take the left
  const std::size_t free = std::min(crossings(problem, line).size(), kMost);
  std::vector<std::pair<double, BaseLine>> found;
  for (std::size_t sides = 0; sides < (std::size_t{1} << free); ++sides) {
    BaseLine past = line;
    double longest = 0.0;
    constexpr int kRounds = 4;  // a detour may lead into another disc
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<Crossing> now = crossings(problem, past);
      if (now.empty()) {
        break;
      }
      for (std::size_t i = 0; i < now.size(); ++i) {
        const double side = ((sides >> std::min(i, kMost - 1)) & 1U) == 0U ? 1.0 : -1.0;
        longest = std::max(longest, push(now[i], side, past));
      }
    }
    found.emplace_back(longest, std::move(past));
  }
  std::ranges::stable_sort(found, {}, [](const auto& entry) { return entry.first; });
  std::vector<BaseLine> lines;
  lines.reserve(found.size());
  for (auto& entry : found) {
    lines.push_back(std::move(entry.second));
  }
  return lines;
}

bool follow_pose(const PathProblem& problem, const PathGoal& goal, const Eigen::Vector2d* place,
                 JointVector& q) noexcept {
  return Follower(problem).settle(goal, place, q);
}

int follow_poses(const PathProblem& problem, const std::vector<PathGoal>& goals,
                 const JointVector& first, const BaseLine& line, std::vector<JointVector>& q) {
  Follower follower(problem);
  q.assign(goals.size(), first);
  JointVector at = first;
  for (std::size_t k = 1; k < goals.size(); ++k) {
    JointVector next = at;
    if (!follower.settle(goals[k], line.empty() ? nullptr : &line[k], next)) {
      std::fill(q.begin() + static_cast<std::ptrdiff_t>(k), q.end(), at);
      return static_cast<int>(k);
    }
    at = next;
    q[k] = at;
  }
  return -1;
}

}  // namespace thing_kin
