#include "thing_kin/inverse/ik_descent.hpp"

#include <array>
#include <limits>
#include <numbers>
#include <utility>

#include "thing_kin/inverse/damped_step.hpp"

namespace thing_kin {

namespace {

// lambda = kDamping * cost + kLeastDamping (Sugihara 2011): large far away, where the linear model
// is poor; at the solution only enough to keep the normal matrix definite in rounding, so that
// convergence stays quadratic, and fast at a singularity.
constexpr double kDamping = 0.05;
constexpr double kLeastDamping = 1e-16;

constexpr double kLargestTurn = std::numbers::pi / 2;

// A descent is given up where kLeash iterations did not bring the cost below kProgress of what it
// was. On 10 000 random targets for each of five arms these two are flat near their best.
constexpr std::size_t kLeash = 5;
constexpr double kProgress = 0.3;

}  // namespace

bool descend(const IkProblem& problem, int most, IkPoint& point, int& iterations) noexcept {
  Posture posture;
  return descend(problem, most, point, iterations, posture);
}

bool descend(const IkProblem& problem, int most, IkPoint& point, int& iterations,
             Posture& posture) noexcept {
  const auto& [chain, frame, residual, box, mobility, position_tolerance, rotation_tolerance] =
      problem;
  JointVector q = point.q;
  PoseResidual::Value value;
  Jacobian J;
  double best = std::numeric_limits<double>::infinity();
  std::array<double, kLeash> earlier;
  earlier.fill(best);
  for (std::size_t i = 0; std::cmp_less(i, most); ++i) {
    ++iterations;
    place_joints(chain, q.data(), posture);
    residual.evaluate(frame_pose(chain, posture, frame), value);
    const double cost = value.cost();
    if (i == 0 || cost < best) {
      best = cost;
      point.q = q;
      point.value = value;
    }
    if (problem.is_reached(value)) {
      point.q = q;
      point.value = value;
      return true;
    }
    if (cost > kProgress * std::exchange(earlier[i % kLeash], cost)) {
      return false;
    }
    geometric_jacobian(chain, posture, frame, ReferenceFrame::kWorldAligned, J);
    take_damped_step(J, residual.derivative(value), value.e, mobility, nullptr,
                     {kDamping * cost + kLeastDamping, kLargestTurn}, box, q);
  }
  return false;
}

}  // namespace thing_kin
