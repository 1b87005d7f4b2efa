#include "thing_kin/rmma/manipulator_arm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

using Eigen::Vector2d;

/// The quickest motion of one joint over `way`, from rest to rest.
double joint_time(double way, double velocity, double acceleration) noexcept {
  const double ramps = velocity * velocity / acceleration;  // way of speeding up and slowing down
  return way < ramps ? 2.0 * std::sqrt(way / acceleration)
                     : way / velocity + velocity / acceleration;
}

class ArmedRun final : public WorldRun {
 public:
  ArmedRun(std::unique_ptr<WorldRun> run, std::shared_ptr<const ManipulatorArm> arm)
      : run_(std::move(run)), arm_(std::move(arm)), q_(JointVector::Zero(arm_->chain().dof())) {}

  Pose2 pose(double t) override { return run_->pose(t); }
  Pose2 odometry(double t) override { return run_->odometry(t); }

  ArmPlacement place(const Vector2d& command) override {
    arm_->solve(command, q_);
    return run_->place(command);
  }

  bool detects(const Vector2d& tool, const Vector2d& fiducial) override {
    return run_->detects(tool, fiducial);
  }

  double move_time(const Vector2d& from, const Vector2d& to) override {
    return run_->move_time(from, from) + way_time(to);
  }

  double sample_time(const Vector2d& from, const Vector2d& to) override {
    return run_->sample_time(from, from) + way_time(to);
  }

  bool reaches(const Vector2d& command) override {
    JointVector q = q_;
    return arm_->solve(command, q);
  }

 private:
  // Where the arm can't go it stays.
  double way_time(const Vector2d& to) const {
    JointVector q = q_;
    return arm_->solve(to, q) ? arm_->motion_time(q_, q) : 0.0;
  }

  std::unique_ptr<WorldRun> run_;
  std::shared_ptr<const ManipulatorArm> arm_;
  JointVector q_;
};

}  // namespace

ManipulatorArm::ManipulatorArm(std::shared_ptr<const Chain> chain, double height, double turn)
    : chain_(std::move(chain)), height_(height), turn_(turn) {
  auto ik = ClosedFormIk::find(*chain_, chain_->tool());
  if (!ik) {
    throw InvalidArgument("chain", ClosedFormIk::obstacle(*chain_, chain_->tool()),
                          "an arm of six joints with a closed form");
  }
  if (!std::isfinite(height)) {
    throw InvalidArgument("height", text(height), "a finite number of metres");
  }
  if (!std::isfinite(turn)) {
    throw InvalidArgument("turn", text(turn), "a finite number of radians");
  }
  for (const JointVector* limit : {&chain_->velocity_limits(), &chain_->acceleration_limits()}) {
    if (!(limit->array() > 0.0).all() || !limit->allFinite()) {
      throw InvalidArgument("chain", "joints without velocity or acceleration limits",
                            "limits of every joint");
    }
  }
  ik_ = std::make_shared<const ClosedFormIk>(*std::move(ik));
}

bool ManipulatorArm::solve(const Vector2d& displacement, JointVector& q) const noexcept {
  const double c = std::cos(turn_);
  const double s = std::sin(turn_);
  SE3 target;
  target.rotation << c, s, 0.0, s, -c, 0.0, 0.0, 0.0, -1.0;  // z down
  target.translation << displacement.x(), displacement.y(), height_;
  constexpr std::array kBase{0.0, 0.0, 0.0};
  ClosedFormSolutions solutions;
  ik_->solve(target, kBase.data(), solutions, {.seed = q.data(), .closest = false});
  for (const ClosedFormSolution& solution : solutions) {
    if (solution.exact) {
      q = solution.q;
      return true;
    }
  }
  return false;
}

double ManipulatorArm::motion_time(const JointVector& from, const JointVector& to) const noexcept {
  double longest = 0.0;
  for (Eigen::Index i = 0; i < from.size(); ++i) {
    longest = std::max(longest, joint_time(std::abs(to(i) - from(i)), chain_->velocity_limits()(i),
                                           chain_->acceleration_limits()(i)));
  }
  return longest;
}

std::unique_ptr<WorldRun> with_arm(std::unique_ptr<WorldRun> run,
                                   std::shared_ptr<const ManipulatorArm> arm) {
  return std::make_unique<ArmedRun>(std::move(run), std::move(arm));
}

}  // namespace thing_kin
