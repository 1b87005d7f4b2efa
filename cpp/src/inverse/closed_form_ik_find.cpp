#include <algorithm>
#include <cmath>

#include "closed_form_ik_geometry.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/inverse/closed_form_ik.hpp"

namespace thing_kin {

using closed_form::Axes;
using closed_form::Canonical;
using closed_form::Misfit;

namespace {

constexpr std::size_t kArm = 6;

std::size_t base_joints(const Chain& chain) { return chain.base_joints() ? 3 : 0; }

/// Why the chain has the wrong joints; empty if it has not.
std::string wrong_joints(const Chain& chain, int frame) {
  const std::size_t base = base_joints(chain);
  const auto all = static_cast<std::size_t>(chain.dof());
  const auto used =
      static_cast<std::size_t>(chain.frames()[static_cast<std::size_t>(frame)].joints);
  const std::size_t arm = all - std::min(all, base);
  if (arm != kArm) {
    std::string text = std::to_string(arm) + " arm joints: ";
    return text.append(arm > kArm ? "more than six leave infinitely many solutions"
                                  : "fewer than six do not reach a general pose");
  }
  if (used != all) {
    return std::string("a frame before the last joint");
  }
  for (const Chain::Joint& joint : chain.joints().subspan(base)) {
    if (!is_rotary(joint.type)) {
      return "a prismatic arm joint";
    }
  }
  return {};
}

bool has_right_joints(const Chain& chain, int frame) noexcept {
  const std::size_t base = base_joints(chain);
  const std::span<const Chain::Joint> joints = chain.joints();
  return joints.size() == base + kArm &&
         chain.frames()[static_cast<std::size_t>(frame)].joints == chain.dof() &&
         std::all_of(joints.begin() + static_cast<std::ptrdiff_t>(base), joints.end(),
                     [](const Chain::Joint& joint) { return is_rotary(joint.type); });
}

/// In the home frame of the first arm joint.
Axes axes_of(const Chain& chain, int frame) noexcept {
  const std::span<const Chain::Joint> joints = chain.joints().subspan(base_joints(chain));
  Axes axes;
  SE3 at;
  for (std::size_t i = 0; i < kArm; ++i) {
    at = i == 0 ? SE3{} : at * joints[i].fixed;
    axes.direction[i] = at.rotation.col(2).normalized();
    axes.point[i] = at.translation;
  }
  axes.tool = at * chain.frames()[static_cast<std::size_t>(frame)].offset;
  return axes;
}

double middle_of(double lower, double upper) {
  if (std::isfinite(lower) && std::isfinite(upper)) {
    return 0.5 * lower + 0.5 * upper;
  }
  return std::clamp(0.0, lower, upper);
}

}  // namespace

/// Fills a ClosedFormIk.
struct ClosedFormBuilder {
  ClosedFormIk ik;

  ClosedFormBuilder(const Chain& chain, int frame) noexcept {
    ik.chain_ = &chain;
    ik.frame_ = frame;
  }

  template <typename Constants>
  void take(const Canonical<Constants>& made, bool reversed) noexcept {
    const Chain& chain = *ik.chain_;
    const std::span<const Chain::Joint> joints = chain.joints();
    const std::size_t base = base_joints(chain);
    ik.on_base_ = base > 0;
    if (ik.on_base_) {
      const SE3 at_y = joints[0].fixed * joints[1].fixed;
      ik.base_.along_x = joints[0].fixed.rotation.col(2);
      ik.base_.along_y = at_y.rotation.col(2);
      ik.base_.turn = at_y * joints[2].fixed;
    }
    const SE3& to_arm = joints[base].fixed;
    ik.reversed_ = reversed;
    ik.before_ = reversed ? made.root.inverse() : made.root.inverse() * to_arm.inverse();
    ik.after_ = reversed ? to_arm * made.hand : made.hand;
    ik.angle_ = made.angle;
    for (std::size_t i = 0; i < kArm; ++i) {
      ik.joint_[i] = joints[base + (reversed ? kArm - 1 - i : i)].index;
      ik.lower_[i] = chain.lower()[ik.joint_[i]];
      ik.upper_[i] = chain.upper()[ik.joint_[i]];
      ik.middle_[i] = middle_of(ik.lower_[i], ik.upper_[i]);
    }
    ik.arm_ = made.constants;
  }

  /// Misfits: of the two directions, parallel arms and then spherical ones.
  bool build(std::array<Misfit, 4>& misfit) noexcept {
    constexpr double kTolerance = ClosedFormIk::kGeometryTolerance;
    const Axes forward = axes_of(*ik.chain_, ik.frame_);
    ik.length_ = closed_form::length_of(forward);
    if (const auto made = as_parallel(forward, kTolerance, misfit[0])) {
      take(*made, false);
      return true;
    }
    const Axes backward = closed_form::reversed(forward);
    if (const auto made = as_parallel(backward, kTolerance, misfit[1])) {
      take(*made, true);
      return true;
    }
    if (const auto made = as_spherical(forward, kTolerance, misfit[2])) {
      take(*made, false);
      return true;
    }
    if (const auto made = as_spherical(backward, kTolerance, misfit[3])) {
      take(*made, true);
      return true;
    }
    return false;
  }
};

std::optional<ClosedFormIk> ClosedFormIk::find(const Chain& chain, int frame) noexcept {
  std::array<Misfit, 4> misfit;
  if (!has_right_joints(chain, frame)) {
    return std::nullopt;
  }
  ClosedFormBuilder builder(chain, frame);
  return builder.build(misfit) ? std::optional<ClosedFormIk>(builder.ik) : std::nullopt;
}

std::string ClosedFormIk::obstacle(const Chain& chain, int frame) {
  if (!has_right_joints(chain, frame)) {
    return wrong_joints(chain, frame);
  }
  std::array<Misfit, 4> misfit;
  ClosedFormBuilder builder(chain, frame);
  if (builder.build(misfit)) {
    return {};
  }
  if (std::ranges::any_of(misfit, [](const Misfit& m) { return m.degenerate; })) {
    return "an arm that is singular everywhere";
  }
  std::string why = "axes 2, 3, 4 off parallel by " + text(misfit[0].angle);
  why.append(" rad, 3, 4, 5 by ").append(text(misfit[1].angle));
  why.append(" rad, axes 4, 5, 6 off meeting by ").append(text(misfit[2].distance));
  return why.append(" m, 1, 2, 3 by ").append(text(misfit[3].distance)).append(" m");
}

const char* to_string(ArmSingularity singularity) noexcept {
  switch (singularity) {
    case ArmSingularity::kShoulder:
      return "shoulder";
    case ArmSingularity::kElbow:
      return "elbow";
    case ArmSingularity::kWrist:
      return "wrist";
    case ArmSingularity::kNone:
      break;
  }
  return "none";
}

}  // namespace thing_kin
