// The calibration model's derivatives against differences, of every kind of parameter.

#include "thing_kin/estimation/calibration.hpp"

#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "thing_kin/lie/so3.hpp"
#include "thing_kin/model/robots.hpp"

namespace thing_kin {
namespace {

struct Setting {
  CalibrationKind kind;
  bool rows;  // Denavit-Hartenberg, else origins
};

class CalibrationDerivatives : public testing::TestWithParam<Setting> {
 protected:
  std::mt19937 generator{7};
  std::normal_distribution<double> normal;

  double draw(double deviation) { return deviation * normal(generator); }

  SE3 pose(double deviation) {
    Vector6 xi;
    for (double& x : xi) {
      x = draw(deviation);
    }
    return se3_exp(xi);
  }
};

TEST_P(CalibrationDerivatives, AreThoseOfTheErrors) {
  const Chain chain = robots::ur10();
  constexpr int kPostures = 5;
  CalibrationData data;
  data.kind = GetParam().kind;
  data.q = Eigen::MatrixXd::NullaryExpr(6, kPostures, [&] { return draw(1.5); });
  data.torques = Eigen::MatrixXd::NullaryExpr(6, kPostures, [&] { return draw(1.0); });
  data.points = Eigen::Matrix3Xd::NullaryExpr(3, 2, [&] { return draw(0.1); });
  const int measurements = kPostures * data.per_posture();
  data.seen.assign(static_cast<std::size_t>(measurements), true);
  for (int i = 0; i < measurements; ++i) {
    data.poses.push_back(pose(0.7));
  }
  data.places = Eigen::Matrix3Xd::NullaryExpr(3, measurements, [&] { return draw(1.0); });
  CalibrationRequest request{{"base", "tool", "joint_offsets", "joint_scales", "sag"}, {}, 0, {}};
  request.parameters.emplace_back(GetParam().rows ? "dh" : "origins");
  request.sagging = {1, 2};
  if (data.kind == CalibrationKind::kPoints) {
    request.points = 2;
    request.parameters.emplace_back("points");
  }
  CalibrationModel model(chain, calibration_parameters(chain, request));
  CalibrationState state{pose(1.0), pose(0.3), Eigen::VectorXd(model.size())};
  for (double& x : state.values) {
    x = draw(0.2);
  }
  std::vector<int> all(kPostures);
  std::iota(all.begin(), all.end(), 0);
  CalibrationResiduals residuals(model, data, all);
  Eigen::VectorXd e;
  Eigen::VectorXd ahead;
  Eigen::VectorXd behind;
  RowMajorMatrix D(residuals.rows(), residuals.size());
  residuals.errors(state, e, &D);
  constexpr double kStep = 1e-6;  // differences err by its square and by rounding over it
  for (int i = 0; i < model.size(); ++i) {
    CalibrationState moved = state;
    moved.values[i] += kStep;
    residuals.errors(moved, ahead, nullptr);
    moved.values[i] -= 2 * kStep;
    residuals.errors(moved, behind, nullptr);
    const Eigen::VectorXd difference = (ahead - behind) / (2 * kStep);
    EXPECT_LT((difference - D.col(i)).cwiseAbs().maxCoeff(), 1e-8)
        << model.parameters()[static_cast<std::size_t>(i)].name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, CalibrationDerivatives,
                         testing::Values(Setting{CalibrationKind::kPoses, true},
                                         Setting{CalibrationKind::kPoses, false},
                                         Setting{CalibrationKind::kPoints, true},
                                         Setting{CalibrationKind::kHits, false}));

TEST(Calibration, RecenteredIsTheSameArm) {
  const Chain chain = robots::ur5();
  const CalibrationRequest request{{"base", "tool"}, {}, 0, {}};
  CalibrationModel model(chain, calibration_parameters(chain, request));
  CalibrationState state{SE3{}, SE3{}, Eigen::VectorXd::LinSpaced(12, -0.5, 0.6)};
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(6, -1.0, 1.5);
  model.set(state);
  const SE3 before = model.tool(q, q, nullptr, nullptr);
  model.set(model.recentered(state));
  const SE3 after = model.tool(q, q, nullptr, nullptr);
  EXPECT_LT((before.matrix() - after.matrix()).norm(), 1e-14);
}

TEST(Calibration, WithoutTorquesNothingSags) {
  const Chain chain = robots::ur5();
  CalibrationModel model(chain, calibration_parameters(chain, {{"base", "sag"}, {}, 0, {3}}));
  model.set({SE3{}, SE3{}, Eigen::VectorXd::Zero(7)});
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(6, -1.0, 1.5);
  TwistColumns twists(6, 7);
  model.tool(q, Eigen::VectorXd(), &twists, nullptr);
  EXPECT_EQ(twists.col(6).norm(), 0.0);
}

TEST(Calibration, JointTwistsAreTheJacobian) {
  const Chain chain = robots::ur5();
  CalibrationModel model(chain, calibration_parameters(chain, {{"base"}, {}, 0, {}}));
  CalibrationState state{SE3{}, SE3{}, Eigen::VectorXd::Zero(6)};
  model.set(state);
  Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(6, -1.0, 1.5);
  TwistColumns twists(6, 6);
  const SE3 T = model.tool(q, q, nullptr, &twists);
  for (int j = 0; j < 6; ++j) {
    Eigen::VectorXd moved = q;
    moved[j] += 1e-6;
    const SE3 M = model.tool(moved, q, nullptr, nullptr);
    const Eigen::Vector3d v = (M.translation - T.translation) / 1e-6;
    const Eigen::Vector3d w = so3_log(M.rotation * T.rotation.transpose()) / 1e-6;
    EXPECT_LT((v - twists.col(j).head<3>()).norm(), 1e-5);
    EXPECT_LT((w - twists.col(j).tail<3>()).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace thing_kin
