#include "thing_kin/optimization/pose_plan.hpp"

#include <algorithm>
#include <cmath>

#include "pose_search.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/pose_error.hpp"

namespace thing_kin {

namespace {

// Constraints before the clearances, see describe().
constexpr int kPosition = 0;
constexpr int kRotation = 1;
constexpr int kLimits = 2;
constexpr int kDisc = 3;
constexpr int kFirstClearance = 4;

PosePlanOptions checked(PosePlanOptions options, const Chain& chain) {
  options.check(chain);
  return options;
}

JointBox make_box(const Chain& chain, const PosePlanOptions& options) {
  JointBox box(chain);
  if (const auto& base = chain.base_joints()) {
    if (options.base_goal) {
      box.narrow((*base)[0], options.base_goal->x() - options.base_radius,
                 options.base_goal->x() + options.base_radius);
      box.narrow((*base)[1], options.base_goal->y() - options.base_radius,
                 options.base_goal->y() + options.base_radius);
    }
    if (options.heading) {
      box.narrow((*base)[2], (*options.heading)[0], (*options.heading)[1]);
    }
  }
  return box;
}

std::vector<Disc> discs_of(const std::vector<Obstacle>& obstacles) {
  std::vector<Disc> discs;
  for (const Obstacle& obstacle : obstacles) {
    if (const auto* disc = std::get_if<Disc>(&obstacle)) {
      discs.push_back(*disc);
    }
  }
  return discs;
}

void require_base(const Chain& chain, const char* argument) {
  if (!chain.base_joints()) {
    throw InvalidArgument(argument, "one for a robot without a base", "None");
  }
}

}  // namespace

void PosePlanOptions::check(const Chain& chain) const {
  if (chain.dof() < 6) {
    throw InvalidArgument("robot", std::to_string(chain.dof()).append(" joints"),
                          "at least six: with fewer sqrt(kappa/M) is infinite");
  }
  if (base_goal) {
    require_base(chain, "base_goal");
    if (!base_goal->allFinite()) {
      throw InvalidArgument("base_goal", "a number that is not finite", "(x, y), m");
    }
    if (!(base_radius > 0.0) || !std::isfinite(base_radius)) {
      throw InvalidArgument("base_radius", text(base_radius), "a finite number above 0, m");
    }
  }
  if (heading) {
    require_base(chain, "heading");
    const auto& [low, high] = *heading;
    if (!std::isfinite(low) || !std::isfinite(high) || low > high) {
      throw InvalidArgument("heading", text(low).append(" to ").append(text(high)),
                            "two finite angles in rising order, rad");
    }
  }
  constexpr double kLargestWeight = 1e6;  // a product of twelve does not overflow
  for (const double weight : column_weights) {
    if (!(weight >= 0.0 && weight <= kLargestWeight)) {
      throw InvalidArgument("jacobian", text(weight), "weights from 0 to 1e6");
    }
  }
  const auto counting = (column_weights.array() > 0.0).count();
  if (column_weights.size() > 0 && counting < 6) {
    throw InvalidArgument("jacobian", std::to_string(counting).append(" joints that count"),
                          "at least six, without which sqrt(kappa/M) is infinite");
  }
  if (!(tolerance > 0.0)) {
    throw InvalidArgument("tolerance", text(tolerance), "a number above 0");
  }
  const auto at_least = [](const char* name, int value, int least) {
    if (value < least) {
      throw InvalidArgument(name, std::to_string(value),
                            std::string("at least ").append(std::to_string(least)));
    }
  };
  at_least("max_iterations", max_iterations, 1);
  at_least("max_restarts", max_restarts, 0);
  at_least("samples", samples, 0);
  at_least("descents", descents, 1);
}

PosePlanner::PosePlanner(const Chain& chain, int frame, PosePlanOptions options,
                         const LinkSpheres& spheres, std::vector<Obstacle> obstacles)
    : chain_(chain),
      frame_(frame),
      options_(checked(std::move(options), chain)),
      box_(make_box(chain, options_)),
      reach_(chain, frame),
      discs_(discs_of(obstacles)),
      clearances_(chain, spheres, std::move(obstacles)),
      closed_form_(ClosedFormIk::find(chain, frame)),
      sequence_(chain.dof(), options_.rng) {
  for (int j = 0; j < chain.dof(); ++j) {
    crossed_ = crossed_ < 0 && box_.lower(j) > box_.upper(j) ? j : crossed_;
  }
}

PosePlan PosePlanner::solve(const SE3& target, const double* seed) const {
  return crossed_ < 0 ? PoseSearch(*this, target, seed).run() : refuse(target, seed);
}

// Where goal or heading leave a joint no place within its limits.
PosePlan PosePlanner::refuse(const SE3& target, const double* seed) const {
  PosePlan plan;
  const JointBox limits(chain_);
  plan.q = Eigen::Map<const Eigen::VectorXd>(seed, chain_.dof());
  for (Eigen::Index j = 0; j < plan.q.size(); ++j) {
    plan.q[j] = limits.inside(j, plan.q[j]);
  }
  const Vector6 error = pose_error(forward_kinematics(chain_, plan.q.data(), frame_), target);
  plan.position_error = error.head<3>().norm();
  plan.rotation_error = error.tail<3>().norm();
  plan.objective = objective(plan.q);
  plan.worst = kLimits;
  plan.constraint_violation = box_.lower(crossed_) - box_.upper(crossed_);
  return plan;
}

int PosePlanner::constraints() const { return kFirstClearance + clearances_.size(); }

double PosePlanner::objective(const JointVector& q) const noexcept {
  Posture posture;
  place_joints(chain_, q.data(), posture);
  Jacobian J;
  geometric_jacobian(chain_, posture, frame_, ReferenceFrame::kWorldAligned, J);
  const JointVector& weights = options_.column_weights;
  return std::exp(log_dexterity(J, weights.size() > 0 ? weights.data() : nullptr));
}

double PosePlanner::violation(int i, const JointVector& q, double position_error,
                              double rotation_error) const noexcept {
  switch (i) {
    case kPosition:
      return position_error;
    case kRotation:
      return rotation_error;
    case kLimits: {
      double most = 0.0;
      for (Eigen::Index j = 0; j < q.size(); ++j) {
        most = std::max({most, box_.lower(j) - q[j], q[j] - box_.upper(j)});
      }
      return most;
    }
    case kDisc: {
      if (!options_.base_goal) {
        return 0.0;
      }
      const auto& base = *chain_.base_joints();
      const Eigen::Vector2d at(q[base[0]], q[base[1]]);
      return std::max(0.0, (at - *options_.base_goal).norm() - options_.base_radius);
    }
    default: {
      Posture posture;
      place_joints(chain_, q.data(), posture);
      return std::max(0.0, -clearances_.value(posture, q.data(), i - kFirstClearance));
    }
  }
}

std::string PosePlanner::describe(int constraint) const {
  switch (constraint) {
    case kPosition:
      return "the hand's position";
    case kRotation:
      return "the hand's orientation";
    case kLimits:
      return crossed_ < 0
                 ? "joint limits"
                 : std::string("the limits of joint ")
                       .append(quoted(chain_.joint_names()[static_cast<std::size_t>(crossed_)]))
                       .append(", which goal or heading is outside of,");
    case kDisc:
      return "the base's distance from its goal";
    default:
      return std::string("the clearance of ")
          .append(clearances_.describe(constraint - kFirstClearance));
  }
}

bool PosePlanner::is_base_clear(const Eigen::Vector2d& base) const noexcept {
  return std::ranges::all_of(
      discs_, [&](const Disc& disc) { return (base - disc.center).norm() >= disc.radius; });
}

std::string message(const PosePlanner& planner, const PosePlan& plan) {
  if (plan.success()) {
    return "converged";
  }
  const std::string status = to_string(plan.status);
  if (plan.constraint_violation <= planner.options().tolerance) {
    return std::string(status).append(": feasible, but no descent came to its end");
  }
  return std::string(status)
      .append(": ")
      .append(planner.describe(plan.worst))
      .append(" is off by ")
      .append(text(plan.constraint_violation))
      .append(plan.worst == kRotation ? " rad"
              : plan.worst == kLimits ? ""
                                      : " m");
}

}  // namespace thing_kin
