#include "thing_kin/inverse/ik_result.hpp"

#include <algorithm>
#include <utility>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

// "0.31 m and 0.2 rad", without a part that is nothing beside the other.
std::string distance(const IkResult& result) {
  constexpr double kNothing = 1e-9;
  const std::string position = text(result.position_error).append(" m");
  const std::string rotation = text(result.rotation_error).append(" rad");
  if (std::min(result.position_error, result.rotation_error) >= kNothing) {
    return position + " and " + rotation;
  }
  return result.position_error >= result.rotation_error ? position : rotation;
}

std::string joints_at_limits(const Chain& chain, const ActiveLimits& active) {
  std::string list;
  for (std::size_t j = 0; std::cmp_less(j, chain.dof()); ++j) {
    if (active[j] != 0) {
      list.append(list.empty() ? "joint " : ", joint ");
      list.append(quoted(chain.joint_names()[j]));
      list.append(active[j] < 0 ? " at its lower limit" : " at its upper limit");
    }
  }
  return list;
}

}  // namespace

const char* to_string(IkStatus status) {
  constexpr const char* kNames[] = {"success",    "unreachable", "limited",
                                    "step_bound", "budget",      "deadline"};
  return kNames[static_cast<std::size_t>(status)];
}

ActiveLimits active_limits(const Chain& chain, const JointVector& q) noexcept {
  ActiveLimits active{};
  for (Eigen::Index j = 0; j < chain.dof(); ++j) {
    const int side = q[j] <= chain.lower()[j] ? -1 : q[j] >= chain.upper()[j] ? 1 : 0;
    active[static_cast<std::size_t>(j)] = static_cast<std::int8_t>(side);
  }
  return active;
}

std::string message(const Chain& chain, const IkResult& result) {
  switch (result.status) {
    case IkStatus::kSuccess:
      return "reached within " + distance(result);
    case IkStatus::kUnreachable:
      return distance(result) + " beyond reach";
    case IkStatus::kLimited:
      return distance(result) + " away: " + joints_at_limits(chain, result.active_limits);
    case IkStatus::kStepBound:
      return "no solution within max_step of the seed; the closest is " + distance(result) +
             " away";
    case IkStatus::kBudget:
      return "iterations or restarts ran out; the closest is " + distance(result) + " away";
    case IkStatus::kDeadline:
      return "time ran out; the closest is " + distance(result) + " away";
  }
  return "";
}

}  // namespace thing_kin
