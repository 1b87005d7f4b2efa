#include <algorithm>
#include <cmath>
#include <utility>

#include "closed_form_ik_polish.hpp"
#include "closed_form_ik_turns.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/inverse/closed_form_ik.hpp"
#include "thing_kin/kinematics/batch.hpp"

namespace thing_kin {

namespace {

using closed_form::kTurn;

/// From `lowest` to `highest` turns away.
struct Range {
  long lowest = 0, highest = 0;

  std::size_t count() const { return static_cast<std::size_t>(highest - lowest + 1); }
};

Range turns_within(double angle, double lower, double upper) {
  if (!std::isfinite(lower) || !std::isfinite(upper) || angle < lower || angle > upper) {
    return {};
  }
  constexpr double kMany = 1e6;
  Range range;
  range.lowest = -static_cast<long>(std::min(std::floor((angle - lower) / kTurn), kMany));
  range.highest = static_cast<long>(std::min(std::floor((upper - angle) / kTurn), kMany));
  return range;
}

double squared_distance(const JointVector& q, const ClosedFormOptions& options) {
  double sum = 0.0;
  for (int j = 0; j < static_cast<int>(q.size()); ++j) {
    const double difference = q[j] - options.seed[j];
    sum += (options.weights != nullptr ? options.weights[j] : 1.0) * difference * difference;
  }
  return sum;
}

/// Nearest to the seed first; equally near ones stay in order.
std::vector<ClosedFormSolution> by_distance(const std::vector<ClosedFormSolution>& all,
                                            const ClosedFormOptions& options) {
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    order.emplace_back(squared_distance(all[i].q, options), i);
  }
  std::ranges::sort(order);
  std::vector<ClosedFormSolution> sorted;
  sorted.reserve(all.size());
  for (const auto& [distance, i] : order) {
    sorted.push_back(all[i]);
  }
  return sorted;
}

}  // namespace

std::vector<ClosedFormSolution> ClosedFormIk::with_images(const SE3& target,
                                                          const ClosedFormSolutions& solutions,
                                                          const ClosedFormOptions& options) const {
  std::vector<ClosedFormSolution> all;
  for (const ClosedFormSolution& solution : solutions) {
    const std::size_t first = all.size();
    all.push_back(solution);
    for (std::size_t j = 0; j < joint_.size(); ++j) {
      const double angle = solution.q[joint_[j]];
      const Range range = turns_within(angle, lower_[j], upper_[j]);
      const std::size_t so_far = all.size() - first;
      if (all.size() + so_far * (range.count() - 1) > kMostImages) {
        throw InvalidArgument("images", "limits with more than " + std::to_string(kMostImages),
                              "narrower limits");
      }
      for (long turn = range.lowest; turn <= range.highest; ++turn) {
        for (std::size_t i = 0; turn != 0 && i < so_far; ++i) {
          all.push_back(all[first + i]);
          all.back().q[joint_[j]] = angle + kTurn * static_cast<double>(turn);
        }
      }
    }
  }
  for (ClosedFormSolution& solution : all) {
    double pose[16];
    forward_kinematics(*chain_, {solution.q.data(), 1, 1}, frame_, PoseFormat::kMatrix, pose);
    const closed_form::PoseDistance off = closed_form::distance(pose, target);
    solution.position_error = off.position;
    solution.rotation_error = off.rotation;
  }
  return options.seed == nullptr ? all : by_distance(all, options);
}

}  // namespace thing_kin
