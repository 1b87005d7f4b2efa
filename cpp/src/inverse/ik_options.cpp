#include <cmath>

#include "thing_kin/core/error.hpp"
#include "thing_kin/inverse/numeric_ik.hpp"

namespace thing_kin {

namespace {

struct Objective {
  IkObjective value;
  const char* name;
};
constexpr Objective kObjectives[] = {{IkObjective::kNone, "none"},
                                     {IkObjective::kSeed, "seed"},
                                     {IkObjective::kLimits, "limits"},
                                     {IkObjective::kManipulability, "manipulability"}};

void check_tolerance(double tolerance, const char* name) {
  if (!(tolerance > 0.0 && std::isfinite(tolerance))) {
    throw InvalidArgument(name, text(tolerance), "a finite number > 0");
  }
}

void check_count(int count, int least, const char* name) {
  if (count < least) {
    throw InvalidArgument(name, std::to_string(count),
                          std::string("at least ").append(std::to_string(least)));
  }
}

void check_positive(const JointVector& numbers, int n, const char* name, double most) {
  if (numbers.size() == 0) {
    return;
  }
  if (numbers.size() != n) {
    throw InvalidArgument(name, std::to_string(numbers.size()).append(" numbers"),
                          std::to_string(n).append(", one a joint"));
  }
  for (const double number : numbers) {
    if (!(number > 0.0 && number <= most)) {
      throw InvalidArgument(name, text(number), "numbers > 0");
    }
  }
}

void check_weights(const PoseWeights& weights) {
  double sum = 0.0;
  for (const double weight : weights.weight) {
    if (!(weight >= 0.0 && weight <= 1e6 && (weight == 0.0 || weight >= 1e-6))) {
      throw InvalidArgument("weights", text(weight), "numbers that are 0 or in [1e-6, 1e6]");
    }
    sum += weight;
  }
  if (sum == 0.0) {
    throw InvalidArgument("weights", "only zeros", "a coordinate that counts");
  }
}

}  // namespace

IkObjective ik_objective_from_string(const std::string& name) {
  for (const Objective& objective : kObjectives) {
    if (name == objective.name) {
      return objective.value;
    }
  }
  throw InvalidArgument("objective", quoted(name), "'none', 'seed', 'limits' or 'manipulability'");
}

const char* to_string(IkObjective objective) {
  return kObjectives[static_cast<std::size_t>(objective)].name;
}

void IkOptions::check(const Chain& chain) const {
  check_tolerance(position_tolerance, "position_tolerance");
  check_tolerance(rotation_tolerance, "rotation_tolerance");
  check_weights(weights);
  check_positive(joint_weights, chain.dof(), "joint_weights", 1e6);
  check_positive(max_step, chain.dof(), "max_step", std::numeric_limits<double>::infinity());
  check_count(max_iterations, 1, "max_iterations");
  check_count(max_restarts, 0, "max_restarts");
  if (!(deadline > 0.0)) {
    throw InvalidArgument("deadline", text(deadline), "seconds > 0");
  }
}

}  // namespace thing_kin
