#include "thing_kin/optimization/terms_orientation_cone.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "robot_term.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/core/tolerance.hpp"

namespace thing_kin::terms {

namespace {

Eigen::Vector3d unit(const char* argument, const Eigen::Vector3d& way) {
  check_finite(argument, way);
  const double length = way.stableNorm();
  if (!(length > 0.0)) {
    throw InvalidArgument(argument, "no direction", "three finite numbers, not all zero");
  }
  return (way / length).normalized();
}

/// A unit vector orthogonal to a unit vector.
Eigen::Vector3d orthogonal_to(const Eigen::Vector3d& a) {
  Eigen::Index least = 0;
  a.cwiseAbs().minCoeff(&least);
  return a.cross(Eigen::Vector3d::Unit(least)).normalized();
}

/// Of the turned axis a and the direction d. The angle falls with a turn about u.
struct Angle {
  Eigen::Vector3d a;
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  double sine;
  double cosine;

  Angle(Eigen::Vector3d turned, const Eigen::Vector3d& d) : a(std::move(turned)), cosine(a.dot(d)) {
    const Eigen::Vector3d turn = a.cross(d);
    sine = turn.norm();
    // Nearer to a tip than this the direction of the way down is rounding.
    if (sine > 4 * kEpsilon) {
      u = turn / sine;
    } else if (cosine < 0.0) {
      u = orthogonal_to(a);
    }
  }

  bool is_tip() const { return !(sine > 4 * kEpsilon); }
};

class OrientationConeTerm : public FrameTerm {
 public:
  OrientationConeTerm(std::shared_ptr<const Chain> robot, const OrientationCone& of)
      : FrameTerm(std::move(robot), of.frame()), axis_(of.axis()), direction_(of.direction()) {}

  std::string name() const override { return "orientation_cone"; }
  int size() const override { return 1; }

  bool evaluate(const VectorView& x, Eigen::Ref<Eigen::VectorXd> value,
                Eigen::MatrixXd* J) const override {
    const Placed placed = place(x);
    const Angle angle(placed.frame.rotation * axis_, direction_);
    value[0] = std::atan2(angle.sine, angle.cosine);
    if (J != nullptr) {
      *J = -angle.u.transpose() * placed.J.bottomRows<3>();
    }
    return true;
  }

  // With c = cos: d2 angle = -(c/s) (u . w_i) (u . w_j) - d2c/s, where d2c = d . (w_i x (w_j x a))
  // for i no further out than j.
  void add_hessian(const VectorView& x, const VectorView& weights,
                   Eigen::MatrixXd& H) const override {
    const Placed placed = place(x);
    const Angle angle(placed.frame.rotation * axis_, direction_);
    if (angle.is_tip()) {
      return;
    }
    const double scale = -weights[0] / angle.sine;
    const auto joints = robot().joints();
    for (std::size_t m = 0; m < joints.size(); ++m) {
      const int j = joints[m].index;
      const Eigen::Vector3d outer = placed.J.col(j).tail<3>();
      const Eigen::Vector3d turned = outer.cross(angle.a).cross(direction_);
      const Eigen::Vector3d of_outer =
          scale * (angle.cosine * outer.dot(angle.u) * angle.u + turned);
      for (std::size_t k = 0; k <= m; ++k) {
        const int i = joints[k].index;
        const double second = placed.J.col(i).tail<3>().dot(of_outer);
        H(i, j) += second;
        if (i != j) {
          H(j, i) += second;
        }
      }
    }
  }

 private:
  Eigen::Vector3d axis_;
  Eigen::Vector3d direction_;
};

}  // namespace

OrientationCone::OrientationCone(const Eigen::Vector3d& axis, const Eigen::Vector3d& direction,
                                 std::string frame)
    : axis_(unit("axis", axis)),
      direction_(unit("direction", direction)),
      frame_(std::move(frame)) {}

std::shared_ptr<const Term> OrientationCone::bind(const std::shared_ptr<const Chain>& robot) const {
  return std::make_shared<OrientationConeTerm>(robot, *this);
}

}  // namespace thing_kin::terms
