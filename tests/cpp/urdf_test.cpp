#include "thing_kin/model/urdf.hpp"

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/lie/so3.hpp"
#include "thing_kin/model/joint_difference.hpp"
#include "thing_kin/model/robots.hpp"
#include "thing_kin/model/urdf_writer.hpp"

namespace thing_kin {
namespace {

// q of the chain that was written is in its own order, of the one read from the root outwards.
void expect_same_kinematics(const Chain& chain, const Chain& again, const Eigen::VectorXd& q) {
  Eigen::VectorXd outwards(q.size());
  for (int i = 0; i < chain.dof(); ++i) {
    outwards[i] = q[chain.description().order[static_cast<std::size_t>(i)]];
  }
  for (const Chain::Frame& frame : chain.frames()) {
    const SE3 T = forward_kinematics(chain, q.data(), chain.frame_index(frame.name));
    const SE3 T_again = forward_kinematics(again, outwards.data(), again.frame_index(frame.name));
    EXPECT_LT((T.matrix() - T_again.matrix()).norm(), 1e-13) << frame.name;
  }
}

TEST(Urdf, GivesBackWhatWasWritten) {
  test::Generator rng(1);
  for (int i = 0; i < 200; ++i) {
    const Chain chain = test::random_chain(rng);
    const Chain again = from_urdf(to_urdf(chain));
    EXPECT_EQ(again.name(), chain.name());
    EXPECT_EQ(again.joint_names(), chain.joint_names());
    expect_same_kinematics(chain, again, test::random_vector(rng, chain.dof()));
  }
}

TEST(Urdf, TheThingComesBackRootOutwards) {
  const Chain thing = robots::thing();
  const Chain again = from_urdf(to_urdf(thing));
  EXPECT_EQ(again.joint_names().front(), "x");
  test::Generator rng(2);
  expect_same_kinematics(thing, again, test::random_vector(rng, thing.dof()));
}

TEST(Urdf, SaysWhatIsWrong) {
  for (const char* text : {"", "<robot>", "<!DOCTYPE robot><robot/>", "<robot name='r'/>",
                           "<robot name='r'><link name='a'/><link name='b'/></robot>"}) {
    EXPECT_THROW(from_urdf(text), InvalidArgument) << text;
  }
  EXPECT_THROW(from_urdf_file("package://none/robot.urdf"), InvalidArgument);
  const std::string text = to_urdf(robots::ur5());
  EXPECT_THROW(from_urdf(text, {.base = "none", .tip = "", .name = ""}), InvalidArgument);
  EXPECT_EQ(from_urdf(text, {.base = "", .tip = "forearm", .name = "three"}).dof(), 3);
}

TEST(RollPitchYaw, GivesTheRotationBack) {
  test::Generator rng(3);
  for (int i = 0; i < 1000; ++i) {
    Eigen::Vector3d rpy = test::random_vector(rng, 3);
    if (i % 2 == 0) {  // at and near the poles
      rpy[1] = (i % 4 == 0 ? 1 : -1) * (M_PI / 2 - std::pow(10.0, -(i % 20)));
    }
    const Eigen::Matrix3d R = rotation_from_rpy(rpy);
    EXPECT_LT((rotation_from_rpy(rpy_from_rotation(R)) - R).norm(), 2e-15) << rpy.transpose();
  }
  const Eigen::Matrix3d pole = rotation_from_rpy({1.0, M_PI / 2, 0.5});
  EXPECT_EQ(rpy_from_rotation(pole)[0], 0.0);
}

TEST(JointDifference, WrapsContinuousJointsOnly) {
  std::vector<DhRow> rows(2);
  rows[0].joint = JointType::kContinuous;
  rows[1].joint = JointType::kRevolute;
  const Eigen::Vector2d from(3.0, 3.0);
  const Eigen::Vector2d to(-3.0 + 2000 * M_PI, -3.0);
  Eigen::Vector2d difference;
  joint_difference(Chain::from_dh(rows), from.data(), to.data(), difference.data());
  EXPECT_NEAR(difference[0], 2 * M_PI - 6.0, 1e-12);  // q itself is rounded to 1e-12
  EXPECT_EQ(difference[1], -6.0);
  EXPECT_EQ(shortest_turn(M_PI), -M_PI);
  EXPECT_EQ(shortest_turn(-M_PI), -M_PI);
}

}  // namespace
}  // namespace thing_kin
