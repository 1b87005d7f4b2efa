#include "thing_kin/kinematics/jacobian.hpp"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/kinematics/hessian.hpp"

namespace thing_kin {
namespace {

// Automatic differentiation of the product of (3.7): shares nothing with the geometric Jacobian.
using Jet = ceres::Jet<double, 12>;
using JetMatrix = Eigen::Matrix<Jet, 4, 4>;

JetMatrix row_transform(const DhRow& row, const Jet& variable) {
  const bool revolute = is_rotary(row.joint);
  const bool prismatic = row.joint == JointType::kPrismatic;
  const Jet theta = revolute ? row.theta + variable : Jet(row.theta);
  const Jet d = prismatic ? row.d + variable : Jet(row.d);
  const Jet ct = cos(theta);
  const Jet st = sin(theta);
  const double ca = std::cos(row.alpha);
  const double sa = std::sin(row.alpha);
  JetMatrix T;
  T << ct, -ca * st, sa * st, row.a * ct,  //
      st, ca * ct, -sa * ct, row.a * st,   //
      Jet(0), Jet(sa), Jet(ca), d,         //
      Jet(0), Jet(0), Jet(0), Jet(1);
  return T;
}

JetMatrix differentiate(const std::vector<DhRow>& rows, const Eigen::VectorXd& q) {
  JetMatrix T = JetMatrix::Identity();
  int joint = 0;
  for (const DhRow& row : rows) {
    const bool moves = row.joint != JointType::kFixed;
    T = T * row_transform(row, moves ? Jet(q[joint], joint) : Jet(0));
    joint += moves ? 1 : 0;
  }
  return T;
}

TEST(Jacobian, AgreesWithAutomaticDifferentiation) {
  test::Generator rng(1);
  Posture posture;
  Jacobian J;
  for (int i = 0; i < 300; ++i) {
    const std::vector<DhRow> rows = test::random_rows(rng);
    const Chain chain = Chain::from_dh(rows);
    const Eigen::VectorXd q = test::random_vector(rng, chain.dof());
    const JetMatrix T = differentiate(rows, q);
    place_joints(chain, q.data(), posture);
    geometric_jacobian(chain, posture, chain.tool(), ReferenceFrame::kWorldAligned, J);
    for (int k = 0; k < chain.dof(); ++k) {
      Eigen::Matrix3d R;
      Eigen::Matrix3d dR;
      for (int entry = 0; entry < 9; ++entry) {
        R(entry / 3, entry % 3) = T(entry / 3, entry % 3).a;
        dR(entry / 3, entry % 3) = T(entry / 3, entry % 3).v[k];
      }
      const Eigen::Matrix3d W = dR * R.transpose();  // skew(omega)
      EXPECT_NEAR(J(0, k), T(0, 3).v[k], 1e-13);
      EXPECT_NEAR(J(1, k), T(1, 3).v[k], 1e-13);
      EXPECT_NEAR(J(2, k), T(2, 3).v[k], 1e-13);
      EXPECT_NEAR(J(3, k), W(2, 1), 1e-13);
      EXPECT_NEAR(J(4, k), W(0, 2), 1e-13);
      EXPECT_NEAR(J(5, k), W(1, 0), 1e-13);
    }
  }
}

TEST(Hessian, AgreesWithDifferencesInEveryFrame) {
  test::Generator rng(2);
  auto H = std::make_unique<Hessian>();
  Posture posture;
  Jacobian plus;
  Jacobian minus;
  for (int i = 0; i < 50; ++i) {
    const Chain chain = test::random_chain(rng);
    const Eigen::VectorXd q = test::random_vector(rng, chain.dof());
    for (const auto reference :
         {ReferenceFrame::kWorldAligned, ReferenceFrame::kBody, ReferenceFrame::kWorld}) {
      place_joints(chain, q.data(), posture);
      geometric_hessian(chain, posture, chain.tool(), reference, *H);
      for (int k = 0; k < chain.dof(); ++k) {
        Eigen::VectorXd moved = q;
        moved[k] = q[k] + 1e-6;
        place_joints(chain, moved.data(), posture);
        geometric_jacobian(chain, posture, chain.tool(), reference, plus);
        moved[k] = q[k] - 1e-6;
        place_joints(chain, moved.data(), posture);
        geometric_jacobian(chain, posture, chain.tool(), reference, minus);
        const Jacobian central = (plus - minus) / 2e-6;
        EXPECT_LT((central - (*H)[static_cast<std::size_t>(k)]).norm(), 1e-7);
      }
    }
  }
}

}  // namespace
}  // namespace thing_kin
