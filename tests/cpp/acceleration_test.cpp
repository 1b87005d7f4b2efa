#include "thing_kin/kinematics/acceleration.hpp"

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "thing_kin/kinematics/jacobian_dot.hpp"

namespace thing_kin {
namespace {

// A pose along a path with its first two time derivatives: the product of (3.7), differentiated by
// the product rule. It shares nothing with the brackets of the library.
struct Path {
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d dT = Eigen::Matrix4d::Zero();
  Eigen::Matrix4d ddT = Eigen::Matrix4d::Zero();

  Path operator*(const Path& b) const {
    return {T * b.T, dT * b.T + T * b.dT, ddT * b.T + 2 * dT * b.dT + T * b.ddT};
  }
};

Path row_path(const DhRow& row, double q, double qd, double qdd) {
  const bool slides = row.joint == JointType::kPrismatic;
  DhRow moved = row;
  (slides ? moved.d : moved.theta) += q;
  const double c = std::cos(moved.theta);
  const double s = std::sin(moved.theta);
  const double ca = std::cos(row.alpha);
  const double sa = std::sin(row.alpha);
  Eigen::Matrix4d T;
  T << c, -ca * s, sa * s, row.a * c,  //
      s, ca * c, -sa * c, row.a * s,   //
      0, sa, ca, moved.d,              //
      0, 0, 0, 1;
  // dT/dq = generator T, constant.
  Eigen::Matrix4d generator = Eigen::Matrix4d::Zero();
  if (slides) {
    generator(2, 3) = 1;
  } else {
    generator(0, 1) = -1;
    generator(1, 0) = 1;
  }
  return {T, qd * generator * T, (qdd * generator + qd * qd * generator * generator) * T};
}

Eigen::Vector3d vee(const Eigen::Matrix3d& S) { return {S(2, 1), S(0, 2), S(1, 0)}; }

// [p''; w'] of a point, axes of the root.
Vector6 classical(const Path& path, const Eigen::Vector3d& point) {
  const Eigen::Matrix3d R = path.T.topLeftCorner<3, 3>();
  const Eigen::Matrix3d dR = path.dT.topLeftCorner<3, 3>();
  const Eigen::Matrix3d ddR = path.ddT.topLeftCorner<3, 3>();
  Vector6 a;
  a << ddR * point + path.ddT.topRightCorner<3, 1>(),
      vee(ddR * R.transpose() + dR * dR.transpose());
  return a;
}

TEST(Acceleration, AgreesWithTheProductRule) {
  test::Generator rng(1);
  Posture posture;
  for (int i = 0; i < 300; ++i) {
    const std::vector<DhRow> rows = test::random_rows(rng);
    const Chain chain = Chain::from_dh(rows);
    const Eigen::VectorXd q = test::random_vector(rng, chain.dof());
    const Eigen::VectorXd qd = test::random_vector(rng, chain.dof(), 1.0);
    const Eigen::VectorXd qdd = test::random_vector(rng, chain.dof(), 1.0);
    const Eigen::Vector3d point = test::random_vector(rng, 3);
    Path path;
    int joint = 0;
    for (const DhRow& row : rows) {
      const bool moves = row.joint != JointType::kFixed;
      path =
          path * (moves ? row_path(row, q[joint], qd[joint], qdd[joint]) : row_path(row, 0, 0, 0));
      joint += moves ? 1 : 0;
    }
    place_joints(chain, q.data(), posture);
    const Vector6 a =
        frame_acceleration(chain, posture, {chain.tool(), point}, ReferenceFrame::kWorldAligned,
                           AccelerationKind::kClassical, qd.data(), qdd.data());
    // Twelve rates up to 1 and lengths up to 40 m: p'' is below 6000 m/s^2.
    EXPECT_LT((a - classical(path, point)).lpNorm<Eigen::Infinity>(), 1e-11);
  }
}

TEST(JacobianDot, TimesQdIsTheDriftInEveryFrame) {
  test::Generator rng(2);
  Posture posture;
  Jacobian dJ;
  for (int i = 0; i < 100; ++i) {
    const Chain chain = test::random_chain(rng);
    const Eigen::VectorXd q = test::random_vector(rng, chain.dof());
    const Eigen::VectorXd qd = test::random_vector(rng, chain.dof(), 1.0);
    place_joints(chain, q.data(), posture);
    for (const auto reference :
         {ReferenceFrame::kWorldAligned, ReferenceFrame::kBody, ReferenceFrame::kWorld}) {
      geometric_jacobian_dot(chain, posture, chain.tool(), reference, qd.data(), dJ);
      const Vector6 drift = frame_drift(chain, posture, chain.tool(), reference, qd.data());
      EXPECT_LT((dJ * qd - drift).lpNorm<Eigen::Infinity>(), 1e-11);
    }
  }
}

}  // namespace
}  // namespace thing_kin
