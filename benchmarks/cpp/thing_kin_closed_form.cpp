#include <memory>
#include <utility>
#include <vector>

#include "problem.hpp"
#include "thing_kin/inverse/closed_form_ik.hpp"
#include "thing_kin/kinematics/posture.hpp"
#include "thing_kin/model/robots.hpp"

namespace {

using bench::Problem;
using namespace thing_kin;

/// A UR10 and targets that it reaches in eight ways, one an input.
struct Questions {
  explicit Questions(Chain chain)
      : arm(std::move(chain)), ik(*ClosedFormIk::find(arm, arm.tool())) {
    ClosedFormSolutions found;
    std::vector<SE3> good;
    for (const Problem::Input& input : bench::problem().inputs) {
      const SE3 T = forward_kinematics(arm, input.q.data() + 3, arm.tool());
      ik.solve(T, nullptr, found);
      if (found.count == 8) {
        good.push_back(T);
      }
    }
    for (std::size_t i = 0; i < bench::kInputs; ++i) {
      targets.push_back(good[i % good.size()]);
    }
  }

  Chain arm;
  ClosedFormIk ik;
  std::vector<SE3> targets;
};

const ClosedFormSolutions& all_eight(const Problem::Input& input) {
  static const Questions questions(robots::ur10());
  static ClosedFormSolutions found;
  const auto i = static_cast<std::size_t>(&input - bench::problem().inputs.data());
  questions.ik.solve(questions.targets[i], nullptr, found);
  return found;
}

Eigen::MatrixXd to_matrix(const ClosedFormSolutions& found) {
  Eigen::MatrixXd q(found.count, 6);
  for (int i = 0; i < found.count; ++i) {
    q.row(i) = found.solutions[static_cast<std::size_t>(i)].q.transpose();
  }
  return q;
}

[[maybe_unused]] const bool entered =
    bench::enter("ik_all_ur10", "thing_kin", all_eight, to_matrix);

}  // namespace
