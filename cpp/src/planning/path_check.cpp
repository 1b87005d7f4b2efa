#include "path_check.hpp"

#include <algorithm>
#include <cmath>

#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/pose_error.hpp"

namespace thing_kin {

namespace {

// One clearance along one segment. Obstacles are convex, so that the distance is a convex function
// of the point, and along the segment it lies above any tangent less half the bound times t^2.
class SegmentScan {
 public:
  SegmentScan(const PathProblem& problem, const JointVector& from, const JointVector& to, int i)
      : problem_(problem), from_(from), dq_(to - from), i_(i) {
    curvature_ = problem.curvature_bound(i, from_.data(), dq_.data());
  }

  struct Point {
    double t, value, slope;
  };

  Point at(double t) const {
    const JointVector q = from_ + t * dq_;
    Posture posture;
    JointVector gradient;
    place_joints(problem_.chain(), q.data(), posture);
    const double value = problem_.clearances().gradient(posture, q.data(), i_, gradient);
    return {t, value, gradient.dot(dq_)};
  }

  // The least value, as far as it matters: exact below -tolerance, else a point found.
  Point least(double tolerance) const {
    const Point a = at(0.0);
    const Point b = at(1.0);
    Point best = a.value < b.value ? a : b;
    descend(a, b, tolerance, 0, best);
    return best;
  }

 private:
  void descend(const Point& a, const Point& b, double tolerance, int depth, Point& best) const {
    constexpr int kDeepest = 30;
    const double h = b.t - a.t;
    // Two tangents; below both, and by curvature_ h^2/2 lower, there is nothing.
    double bound = std::min(a.value, b.value);
    double meet = 0.5 * (a.t + b.t);
    if (a.slope < 0.0 || b.slope > 0.0) {
      const double difference = a.slope - b.slope;
      if (difference < 0.0) {
        meet = (b.value - a.value + a.slope * a.t - b.slope * b.t) / difference;
        meet = std::clamp(meet, a.t, b.t);
      }
      bound = std::min(
          bound, std::max(a.value + a.slope * (meet - a.t), b.value + b.slope * (meet - b.t)));
    }
    // Where it is below, its depth need not be known any better than by a hundredth.
    const double enough = std::min(-tolerance, best.value - 0.01 * std::abs(best.value));
    if (bound - 0.5 * curvature_ * h * h >= enough || depth == kDeepest) {
      return;
    }
    const Point middle = at(std::clamp(meet, a.t + 0.1 * h, b.t - 0.1 * h));
    best = middle.value < best.value ? middle : best;
    descend(a, middle, tolerance, depth + 1, best);
    descend(middle, b, tolerance, depth + 1, best);
  }

  const PathProblem& problem_;
  JointVector from_, dq_;
  int i_;
  double curvature_;
};

class Checker {
 public:
  Checker(const PathProblem& problem, const std::vector<PathGoal>& goals,
          const std::vector<JointVector>& q, PoseTolerance poses, double tolerance)
      : problem_(problem), goals_(goals), q_(q), poses_(poses), tolerance_(tolerance) {}

  std::vector<PathMiss> run(double& largest) {
    const std::vector<SegmentContact> contacts = find_contacts(problem_, q_, tolerance_);
    std::size_t next = 0;
    for (std::size_t k = 0; k < q_.size(); ++k) {
      worst_ = {static_cast<int>(k), tolerance_, ""};
      waypoint(k);
      if (k + 1 < q_.size()) {
        step(k);
      }
      for (; next < contacts.size() && std::cmp_equal(contacts[next].segment, k); ++next) {
        largest_ = std::max(largest_, -contacts[next].value);
        if (!worst_.constraint.empty()) {
          continue;  // what is amiss at the waypoint itself says more
        }
        const std::string what = problem_.clearances().describe(contacts[next].clearance);
        note(-contacts[next].value, std::string(what).append(" on the way to the next waypoint"));
      }
      if (!worst_.constraint.empty()) {
        misses_.push_back(worst_);
      }
    }
    largest = largest_;
    return misses_;
  }

 private:
  void note(double amount, std::string constraint) {
    largest_ = std::max(largest_, std::isnan(amount) ? kUnlimited : amount);
    if (!(amount <= worst_.amount)) {
      worst_.amount = amount;
      worst_.constraint = std::move(constraint);
    }
  }

  std::string joint(int j) const {
    return quoted(problem_.chain().joint_names()[static_cast<std::size_t>(j)]);
  }

  void waypoint(std::size_t k) {
    const Chain& chain = problem_.chain();
    const JointVector& q = q_[k];
    for (int j = 0; j < problem_.dof(); ++j) {
      const double out = std::max(chain.lower()[j] - q[j], q[j] - chain.upper()[j]);
      if (out > tolerance_) {
        note(out, std::string("the limit of joint ").append(joint(j)));
      }
    }
    base(k);
    Posture posture;
    place_joints(chain, q.data(), posture);
    for (int i = 0; i < problem_.clearances().size(); ++i) {
      const double value = problem_.clearances().value(posture, q.data(), i);
      if (!(value >= -tolerance_)) {
        note(-value, problem_.clearances().describe(i));
      }
      largest_ = std::max(largest_, -value);
    }
    pose(k);
  }

  void pose(std::size_t k) {
    const SE3 T = forward_kinematics(problem_.chain(), q_[k].data(), problem_.frame());
    const double position = (goals_[k].pose.translation - T.translation).norm();
    const double rotation = rotation_angle(T.rotation, goals_[k].pose.rotation);
    if (!(position <= poses_.position && rotation <= poses_.rotation)) {
      worst_.amount = std::max(position, rotation);
      worst_.constraint = "pose";
    }
  }

  void base(std::size_t k) {
    if (!problem_.chain().base_joints()) {
      return;
    }
    const auto& places = *problem_.chain().base_joints();
    const JointVector& q = q_[k];
    if (problem_.has_base_path) {
      const double away =
          std::hypot(q[places[0]] - goals_[k].base[0], q[places[1]] - goals_[k].base[1]);
      note(away - problem_.base_radius, "base_radius");
    }
    const double theta = q[places[2]];
    note(std::max(goals_[k].heading_lower - theta, theta - goals_[k].heading_upper), "heading");
  }

  void step(std::size_t k) {
    for (int j = 0; j < problem_.dof(); ++j) {
      const double beyond = std::abs(q_[k + 1][j] - q_[k][j]) - problem_.max_joint_step[j];
      if (beyond > tolerance_) {
        note(beyond, std::string("max_joint_step of joint ").append(joint(j)));
      }
    }
  }

  const PathProblem& problem_;
  const std::vector<PathGoal>& goals_;
  const std::vector<JointVector>& q_;
  PoseTolerance poses_;
  double tolerance_;
  double largest_ = 0.0;
  PathMiss worst_;
  std::vector<PathMiss> misses_;
};

}  // namespace

std::vector<SegmentContact> find_contacts(const PathProblem& problem,
                                          const std::vector<JointVector>& q, double tolerance) {
  std::vector<SegmentContact> contacts;
  for (std::size_t k = 0; k + 1 < q.size(); ++k) {
    const JointVector dq = q[k + 1] - q[k];
    Posture posture;
    place_joints(problem.chain(), q[k].data(), posture);
    for (int i = 0; i < problem.clearances().size(); ++i) {
      const double value = problem.clearances().value(posture, q[k].data(), i);
      if (value > problem.motion_bound(i, q[k].data(), dq.data())) {
        continue;
      }
      const auto least = SegmentScan(problem, q[k], q[k + 1], i).least(tolerance);
      if (!(least.value >= -tolerance)) {
        contacts.push_back({static_cast<int>(k), i, least.t, least.value});
      }
    }
  }
  return contacts;
}

std::vector<PathMiss> check_path(const PathProblem& problem, const std::vector<PathGoal>& goals,
                                 const std::vector<JointVector>& q, PoseTolerance poses,
                                 double tolerance, double& largest) {
  return Checker(problem, goals, q, poses, tolerance).run(largest);
}

}  // namespace thing_kin
