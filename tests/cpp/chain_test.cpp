#include "thing_kin/model/chain.hpp"

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/posture.hpp"
#include "thing_kin/model/robots.hpp"

namespace thing_kin {
namespace {

// The product of (3.7), row by row, nothing folded.
SE3 product_of_rows(const std::vector<DhRow>& rows, const Eigen::VectorXd& q) {
  SE3 T;
  int joint = 0;
  for (const DhRow& row : rows) {
    const bool revolute = is_rotary(row.joint);
    const double variable = row.joint == JointType::kFixed ? 0.0 : q[joint++];
    T = T * dh_transform(row.d + (revolute ? 0.0 : variable),
                         row.theta + (revolute ? variable : 0.0), row.a, row.alpha);
  }
  return T;
}

TEST(Chain, FoldedEqualsTheProductOfRows) {
  test::Generator rng(1);
  for (int i = 0; i < 300; ++i) {
    const std::vector<DhRow> rows = test::random_rows(rng);
    const Chain chain = Chain::from_dh(rows);
    const Eigen::VectorXd q = test::random_vector(rng, chain.dof());
    const SE3 T = forward_kinematics(chain, q.data(), chain.tool());
    const SE3 expected = product_of_rows(rows, q);
    EXPECT_LT((T.matrix() - expected.matrix()).norm(), 1e-13);
  }
}

TEST(Chain, RightAnglesAreExact) {
  const SE3 T = dh_transform(0.0, -M_PI / 2, 0.0, M_PI);
  EXPECT_EQ(T.rotation(0, 0), 0.0);
  EXPECT_EQ(T.rotation(1, 0), -1.0);
  EXPECT_EQ(T.rotation(2, 2), -1.0);
}

TEST(Chain, BothOrdersAreTheSameRobot) {
  test::Generator rng(2);
  const Chain arm_first = robots::thing(JointOrder::kArmFirst);
  const Chain base_first = robots::thing(JointOrder::kBaseFirst);
  const Eigen::VectorXd q = test::random_vector(rng, 9);
  Eigen::VectorXd p(9);
  p << q.tail(3), q.head(6);
  EXPECT_EQ(forward_kinematics(arm_first, q.data(), arm_first.tool()),
            forward_kinematics(base_first, p.data(), base_first.tool()));
}

TEST(Chain, RefusesWhatIsNoChain) {
  EXPECT_THROW(Chain::from_dh({}), InvalidArgument);
  EXPECT_THROW(Chain::from_dh(std::vector<DhRow>(1)), InvalidArgument);
  DhRow row;
  row.joint = JointType::kRevolute;
  EXPECT_THROW(Chain::from_dh(std::vector<DhRow>(kMaxDof + 1, row)), InvalidArgument);
  row.name = "same";
  EXPECT_THROW(Chain::from_dh(std::vector<DhRow>(2, row)), InvalidArgument);
  row.limits = {1.0, -1.0};
  EXPECT_THROW(Chain::from_dh(std::vector<DhRow>(1, row)), InvalidArgument);
  EXPECT_THROW(on_omni_base(robots::thing(), SE3{}), InvalidArgument);
}

}  // namespace
}  // namespace thing_kin
