#include "thing_kin/inverse/closed_form_ik.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "closed_form_ik_polish.hpp"
#include "closed_form_ik_subproblems.hpp"
#include "closed_form_ik_turns.hpp"
#include "thing_kin/kinematics/arc_tangent.hpp"
#include "thing_kin/kinematics/batch.hpp"

namespace thing_kin {

using closed_form::Branch;
using closed_form::Branches;
using closed_form::Goal;
using closed_form::PoseDistance;
using closed_form::Question;

namespace {

constexpr double kExact = 1e-9;        // m and rad: what "exact" promises
constexpr double kAccurate = 1e-12;    // m and rad per m of distance: no need to polish
constexpr double kPromising = 1e-5;    // an excess that polishing may still mend
constexpr double kSame = 1e-6;         // rad: rounding of a double root
constexpr double kSameClosest = 1e-4;  // rad: of a minimum
constexpr double kAlike = 1e-6;        // relative: equally close
constexpr int kMost = ClosedFormSolutions::kMost;
constexpr int kMostJoints = 9;

/// The rotation nearest to one that is off by rounding, by Newton's step on R^T R = I.
Eigen::Matrix3d orthonormal(const Eigen::Matrix3d& R) {
  const Eigen::Matrix3d off = R.transpose() * R - Eigen::Matrix3d::Identity();
  const double size = off.cwiseAbs().maxCoeff();
  if (size <= 4e-16) {
    return R;
  }
  const Eigen::Matrix3d nearer = R - 0.5 * R * off;
  return size > 1e-8 ? orthonormal(nearer) : nearer;
}

SE3 seen_from(const SE3& base, const SE3& target) {
  return {base.rotation.transpose() * target.rotation,
          base.rotation.transpose() * (target.translation - base.translation)};
}

}  // namespace

/// One call of solve().
class ClosedFormRun {
 public:
  ClosedFormRun(const ClosedFormIk& ik, const SE3& target, const double* base,
                const ClosedFormOptions& options) noexcept
      : ik_(ik),
        options_(options),
        goal_{*ik.chain_, ik.frame_, {orthonormal(target.rotation), target.translation}, ik.joint_},
        base_(base),
        n_(ik.chain_->dof()) {}

  void solve(ClosedFormSolutions& out) noexcept {
    if (!std::isfinite(goal_.target.rotation.sum() + goal_.target.translation.sum())) {
      out.count = 0;
      out.status = ClosedFormStatus::kUnreachable;
      return;
    }
    answer();
    measure();
    count_ = branches_.count;
    for (int i = 0; i < count_; ++i) {
      set_row(i);
    }
    keep_exact();
    bool reachable = count_ > 0;
    if (!reachable && options_.closest) {
      keep_closest();
      reachable = count_ > 0 && rows_[0].off.within(kExact);
    }
    out.status = reachable ? ClosedFormStatus::kSolved : ClosedFormStatus::kUnreachable;
    leave_out_beyond_limits(out);
    if (reachable && count_ == 0) {
      out.status = ClosedFormStatus::kOutsideLimits;
    }
    merge(reachable ? kSame : kSameClosest);
    write(out);
  }

 private:
  struct Row {
    PoseDistance off;
    double excess = 0.0;
    ArmSingularity singularity = ArmSingularity::kNone;
    int joint = -1;       ///< that is out of its limits most
    double beyond = 0.0;  ///< by so much
  };

  double* q(int row) { return q_ + row * n_; }

  double reference(std::size_t j) const {
    constexpr double kFarthest = 1e6;  // rad; turns beyond would cost digits
    if (options_.seed != nullptr && std::abs(options_.seed[ik_.joint_[j]]) <= kFarthest) {
      return options_.seed[ik_.joint_[j]];
    }
    return ik_.middle_[j];
  }

  /// Branches of the canonical arm.
  void answer() noexcept {
    double stay[6];
    for (std::size_t j = 0; j < 6; ++j) {
      stay[j] = ik_.angle_[j].sign * reference(j) + ik_.angle_[j].offset;
    }
    const SE3 local = ik_.on_base_ ? seen_from(ik_.base_.pose(base_), goal_.target) : goal_.target;
    const SE3 canonical = ik_.before_ * (ik_.reversed_ ? local.inverse() : local) * ik_.after_;
    const Question question{canonical.rotation, canonical.translation, ik_.length_, stay};
    branches_.count = 0;
    if (const auto* parallel = std::get_if<closed_form::ParallelArm>(&ik_.arm_)) {
      solve_arm(*parallel, question, branches_);
    } else {
      solve_arm(*std::get_if<closed_form::SphericalArm>(&ik_.arm_), question, branches_);
    }
  }

  /// The canonical angles of all branches, in radians.
  void measure() noexcept {
    double sine[6 * kMost];
    double cosine[6 * kMost];
    for (int i = 0; i < branches_.count; ++i) {
      for (int j = 0; j < 6; ++j) {
        const Branch& branch = branches_.branch[static_cast<std::size_t>(i)];
        const closed_form::Angle& angle = branch.angle[static_cast<std::size_t>(j)];
        sine[6 * i + j] = angle.sin;
        cosine[6 * i + j] = angle.cos;
      }
    }
    arc_tangents(sine, cosine, 6L * branches_.count, angles_);
  }

  void set_row(int i) noexcept {
    const Branch& branch = branches_.branch[static_cast<std::size_t>(i)];
    double* to = q(i);
    if (ik_.on_base_) {
      const std::array<int, 3>& places = *ik_.chain_->base_joints();
      for (std::size_t j = 0; j < 3; ++j) {
        to[places[j]] = base_[j];
      }
    }
    const double* angle = angles_ + 6 * i;
    for (std::size_t j = 0; j < 6; ++j) {
      to[ik_.joint_[j]] = ik_.angle_[j].sign * (angle[j] - ik_.angle_[j].offset);
    }
    Row& row = rows_[i];
    row = Row{};
    row.excess = branch.excess;
    row.singularity = named(branch.singularity);
    turn_near(i);
  }

  /// In an arm solved backwards the wrist is the shoulder.
  ArmSingularity named(ArmSingularity s) const {
    if (!ik_.reversed_ || s == ArmSingularity::kNone || s == ArmSingularity::kElbow) {
      return s;
    }
    return s == ArmSingularity::kWrist ? ArmSingularity::kShoulder : ArmSingularity::kWrist;
  }

  /// Turns each joint by whole turns: nearest to the reference, but within limits if it can be.
  void turn_near(int i) noexcept {
    Row& row = rows_[i];
    row.beyond = 0.0;
    for (std::size_t j = 0; j < 6; ++j) {
      double& angle = q(i)[ik_.joint_[j]];
      angle = closed_form::turned_near(reference(j), angle);
      if (!options_.respect_limits || (angle >= ik_.lower_[j] && angle <= ik_.upper_[j])) {
        continue;
      }
      const double beyond = closed_form::put_inside(ik_.lower_[j], ik_.upper_[j], angle);
      if (beyond > row.beyond) {
        row.beyond = beyond;
        row.joint = ik_.joint_[j];
      }
    }
  }

  void keep(int from, int to) noexcept {
    if (from != to) {
      std::copy_n(q(from), n_, q(to));
      rows_[to] = rows_[from];
    }
  }

  /// All rows' distances, by the library's own forward kinematics.
  void verify() noexcept {
    double poses[16 * kMost];
    forward_kinematics(*ik_.chain_, {q_, static_cast<std::size_t>(count_), 1}, ik_.frame_,
                       PoseFormat::kMatrix, poses);
    for (int i = 0; i < count_; ++i) {
      rows_[i].off = closed_form::distance(poses + 16 * i, goal_.target);
    }
  }

  void improve(int i) noexcept {
    polish(goal_, q(i));
    turn_near(i);
    double pose[16];
    forward_kinematics(*ik_.chain_, {q(i), 1, 1}, ik_.frame_, PoseFormat::kMatrix, pose);
    rows_[i].off = closed_form::distance(pose, goal_.target);
  }

  void keep_exact() noexcept {
    int promising = 0;
    for (int i = 0; i < count_; ++i) {
      if (rows_[i].excess <= kPromising * (1.0 + ik_.length_)) {
        keep(i, promising++);
      }
    }
    count_ = promising;
    verify();
    const double accurate = kAccurate * (1.0 + goal_.target.translation.cwiseAbs().maxCoeff());
    int exact = 0;
    for (int i = 0; i < count_; ++i) {
      if (!rows_[i].off.within(accurate)) {
        improve(i);
      }
      if (rows_[i].off.within(kExact)) {
        keep(i, exact++);
      }
    }
    count_ = exact;
  }

  /// Every branch as near as it comes, and of those the nearest.
  void keep_closest() noexcept {
    count_ = branches_.count;
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < count_; ++i) {
      set_row(i);
      improve(i);
      best = std::min(best, rows_[i].off.squared());
    }
    int close = 0;
    for (int i = 0; i < count_; ++i) {
      const PoseDistance& off = rows_[i].off;
      if (off.squared() <= best * (1.0 + kAlike) || off.within(kExact)) {
        keep(i, close++);
      }
    }
    count_ = close;
  }

  void leave_out_beyond_limits(ClosedFormSolutions& out) noexcept {
    out.outside = 0;
    out.limiting_joint = -1;
    out.beyond_limit = 0.0;
    int inside = 0;
    for (int i = 0; i < count_; ++i) {
      const Row& row = rows_[i];
      if (row.beyond == 0.0) {
        keep(i, inside++);
        continue;
      }
      if (out.outside++ == 0 || row.beyond < out.beyond_limit) {
        out.beyond_limit = row.beyond;
        out.limiting_joint = row.joint;
      }
    }
    count_ = inside;
  }

  bool same(int a, int b, double tolerance) noexcept {
    return std::ranges::all_of(ik_.joint_, [&](int joint) {
      return std::abs(closed_form::turned_near(0.0, q(a)[joint] - q(b)[joint])) <= tolerance;
    });
  }

  /// Branches that meet are one. Only where one is singular can they.
  void merge(double tolerance) noexcept {
    int distinct = 0;
    for (int i = 0; i < count_; ++i) {
      bool known = false;
      if (rows_[i].singularity != ArmSingularity::kNone || tolerance != kSame) {
        for (int j = 0; j < distinct && !known; ++j) {
          known = same(i, j, tolerance);
        }
      }
      if (!known) {
        keep(i, distinct++);
      }
    }
    count_ = distinct;
  }

  double to_seed(int i) noexcept {
    double sum = 0.0;
    for (int j = 0; j < n_; ++j) {
      const double difference = q(i)[j] - options_.seed[j];
      sum += (options_.weights != nullptr ? options_.weights[j] : 1.0) * difference * difference;
    }
    return sum;
  }

  void write(ClosedFormSolutions& out) noexcept {
    std::array<int, kMost> order{};
    std::array<double, kMost> far{};
    for (int i = 0; i < count_; ++i) {  // each behind those that are as near
      far[static_cast<std::size_t>(i)] = options_.seed != nullptr ? to_seed(i) : 0.0;
      int place = i;
      for (; place > 0; --place) {
        const int before = order[static_cast<std::size_t>(place - 1)];
        if (far[static_cast<std::size_t>(before)] <= far[static_cast<std::size_t>(i)]) {
          break;
        }
        order[static_cast<std::size_t>(place)] = before;
      }
      order[static_cast<std::size_t>(place)] = i;
    }
    out.count = count_;
    for (int i = 0; i < count_; ++i) {
      const int from = order[static_cast<std::size_t>(i)];
      const Row& row = rows_[from];
      ClosedFormSolution& to = out.solutions[static_cast<std::size_t>(i)];
      to.q.resize(n_);
      std::copy_n(q(from), n_, to.q.data());
      to.position_error = row.off.position;
      to.rotation_error = row.off.rotation;
      to.exact = row.off.within(kExact);
      to.singularity = row.singularity;
    }
  }

  const ClosedFormIk& ik_;
  const ClosedFormOptions& options_;
  Goal goal_;
  const double* base_;
  int n_;
  int count_ = 0;
  Branches branches_;
  Row rows_[kMost];
  double angles_[6 * kMost];
  double q_[kMost * kMostJoints];
};

void ClosedFormIk::solve(const SE3& target, const double* base, ClosedFormSolutions& out,
                         const ClosedFormOptions& options) const noexcept {
  ClosedFormRun(*this, target, base, options).solve(out);
}

}  // namespace thing_kin
