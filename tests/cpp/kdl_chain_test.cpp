#include "thing_kin/model/kdl_chain.hpp"

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/kinematics/jacobian.hpp"
#include "thing_kin/model/robots.hpp"

namespace thing_kin {
namespace {

void expect_agreement(const Chain& chain, test::Generator& rng) {
  KdlChain kdl(chain);
  const Eigen::VectorXd q = test::random_vector(rng, chain.dof());
  Posture posture;
  place_joints(chain, q.data(), posture);
  for (int frame = 0; frame <= chain.tool(); ++frame) {
    const Eigen::Matrix4d difference =
        kdl.fk(q, frame).matrix() - frame_pose(chain, posture, frame).matrix();
    EXPECT_LT(difference.norm(), 1e-13) << chain.frames()[static_cast<std::size_t>(frame)].name;
  }
  Jacobian J;
  geometric_jacobian(chain, posture, chain.tool(), ReferenceFrame::kWorldAligned, J);
  EXPECT_LT((kdl.jacobian(q) - J).norm(), 1e-13);
}

TEST(KdlChain, AgreesOnRandomChains) {
  test::Generator rng(1);
  for (int i = 0; i < 200; ++i) {
    expect_agreement(test::random_chain(rng), rng);
  }
}

TEST(KdlChain, AgreesOnTheRobots) {
  test::Generator rng(2);
  for (const Chain& robot : {robots::thing(), robots::thing(JointOrder::kBaseFirst), robots::ur5(),
                             robots::pioneer_lx_ur5()}) {
    expect_agreement(robot, rng);
  }
}

}  // namespace
}  // namespace thing_kin
