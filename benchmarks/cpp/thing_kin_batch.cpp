// Batches on one thread, in arrays that the caller keeps; per row.

#include "problem.hpp"
#include "thing_kin/kinematics/batch.hpp"

namespace {

using bench::kRows;
using namespace thing_kin;

struct Rows {
  std::vector<double> poses = std::vector<double>(16 * kRows);
  std::vector<double> jacobians = std::vector<double>(54 * kRows);
};

JointBatch batch() { return {bench::problem().rows.data(), kRows, 1}; }

// Each answer is a column: the poses, then the Jacobians.
Eigen::VectorXd column(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<long>(numbers.size()));
}

Eigen::VectorXd columns(const Rows& rows) {
  Eigen::VectorXd all(70 * kRows);
  all << column(rows.poses), column(rows.jacobians);
  return all;
}

const std::vector<double>& fk(Rows& rows) {
  const Chain& robot = bench::problem().robot;
  forward_kinematics(robot, batch(), robot.tool(), PoseFormat::kMatrix, rows.poses.data());
  return rows.poses;
}

const Rows& fk_and_jacobian(Rows& rows) {
  const Chain& robot = bench::problem().robot;
  forward_kinematics_and_jacobian(robot, batch(), robot.tool(), ReferenceFrame::kWorldAligned,
                                  rows.poses.data(), rows.jacobians.data());
  return rows;
}

[[maybe_unused]] const bool entered = [] {
  static Rows rows;
  for (const bench::Level level : bench::levels()) {
    const std::string name = bench::name_of(level);
    bench::enter_batch("fk_batch", name, []() -> const auto& { return fk(rows); }, column, level);
    bench::enter_batch(
        "fk_and_jacobian_batch", name, []() -> const auto& { return fk_and_jacobian(rows); },
        columns, level);
  }
  return true;
}();

}  // namespace
