#include <string>

#include "thing_kin/core/error.hpp"
#include "thing_kin/optimization/sqp.hpp"

namespace thing_kin {

namespace {

void require(bool holds, const char* argument, double got, const char* expected) {
  if (!holds) {  // so that NaN does not
    throw InvalidArgument(argument, text(got), expected);
  }
}

bool is_finite_and_above(double value, double least) {
  return value > least && value < std::numeric_limits<double>::infinity();
}

}  // namespace

void SqpOptions::check() const {
  require(c > 0.0 && c < 1.0, "c", c, "a number between 0 and 1");
  require(is_finite_and_above(tau_plus, 1.0), "tau_plus", tau_plus, "a finite number > 1");
  require(tau_minus > 0.0 && tau_minus < 1.0, "tau_minus", tau_minus, "a number between 0 and 1");
  require(is_finite_and_above(k, 1.0), "k", k, "a finite number > 1");
  require(is_finite_and_above(mu0, 0.0), "mu0", mu0, "a finite number > 0");
  require(mu_max >= mu0 && mu_max <= 1e12, "mu_max", mu_max, "mu0 to 1e12");
  require(is_finite_and_above(delta_min, 0.0), "delta_min", delta_min, "a finite number > 0");
  require(delta0 >= delta_min && is_finite_and_above(delta0, 0.0), "delta0", delta0,
          "a finite number >= delta_min");
  require(delta_max >= delta0 && delta_max <= 1e12, "delta_max", delta_max, "delta0 to 1e12");
  require(step_tolerance >= 0.0, "step_tolerance", step_tolerance, "a number >= 0");
  require(improvement_tolerance >= 0.0, "improvement_tolerance", improvement_tolerance,
          "a number >= 0");
  require(is_finite_and_above(constraint_tolerance, 0.0), "constraint_tolerance",
          constraint_tolerance, "a finite number > 0");
  require(is_finite_and_above(optimality_tolerance, 0.0), "optimality_tolerance",
          optimality_tolerance, "a finite number > 0");
  require(max_iterations >= 0, "max_iterations", max_iterations, "a whole number >= 0");
  require(deadline >= 0.0, "deadline", deadline, "seconds >= 0");
}

}  // namespace thing_kin
