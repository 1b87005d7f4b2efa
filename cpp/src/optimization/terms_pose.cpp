#include "thing_kin/optimization/terms_pose.hpp"

#include "robot_term.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/pose_curvature.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin::terms {

namespace {

void check_rotation(const Eigen::Matrix3d& R) {
  const SE3 T{R, Eigen::Vector3d::Zero()};
  if (!is_rigid(T.matrix())) {
    throw InvalidArgument("target", "a matrix that is no rotation",
                          "R^T R = I within 1e-6 and det R = 1");
  }
}

class PositionTerm : public FrameTerm {
 public:
  PositionTerm(std::shared_ptr<const Chain> robot, const Position& of)
      : FrameTerm(std::move(robot), of.frame(), of.point()), target_(of.target()) {}

  std::string name() const override { return "position"; }
  int size() const override { return 3; }

  bool evaluate(const VectorView& x, Eigen::Ref<Eigen::VectorXd> value,
                Eigen::MatrixXd* J) const override {
    const Placed placed = place(x);
    value = target_ - placed.point;
    if (J != nullptr) {
      *J = -placed.J.topRows<3>();
    }
    return true;
  }

  void add_hessian(const VectorView& x, const VectorView& weights,
                   Eigen::MatrixXd& H) const override {
    Vector6 force = Vector6::Zero();
    force.head<3>() = -weights;
    SmallMatrix curvature = SmallMatrix::Zero(x.size(), x.size());
    add_pose_curvature(robot(), place(x).J, force, curvature);
    H += curvature;
  }

 private:
  Eigen::Vector3d target_;
};

/// phi = log(R_goal R^T). A turn w of the frame is exp(-w) on the right of exp(phi), so that
/// dphi/dq_i = -J_r^-1(phi) w_i.
struct RotationError {
  Eigen::Vector3d phi;
  Eigen::Matrix3d inverse;  // J_r^-1

  RotationError(const Eigen::Matrix3d& goal, const Eigen::Matrix3d& R)
      : phi(so3_log(goal * R.transpose())), inverse(so3_right_jacobian_inverse(phi)) {}

  /// The second derivative is d(J_r^-1)[J_r^-1 w_j] w_i - J_r^-1 dw_i/dq_j; its two parts are
  /// symmetric together, so that the symmetric part of each will do.
  void add_hessian(const Chain& robot, const Jacobian& J, const Eigen::Vector3d& weights,
                   SmallMatrix& H) const {
    Vector6 torque = Vector6::Zero();
    torque.tail<3>() = -(inverse.transpose() * weights);
    add_pose_curvature(robot, J, torque, H);
    const Eigen::Matrix3d bend =
        inverse.transpose() * so3_right_jacobian_inverse_derivative(phi, weights);
    const Eigen::Matrix3d symmetric = 0.5 * (bend + bend.transpose());
    H += J.bottomRows<3>().transpose() * symmetric * J.bottomRows<3>();
  }
};

class OrientationTerm : public FrameTerm {
 public:
  OrientationTerm(std::shared_ptr<const Chain> robot, const Orientation& of)
      : FrameTerm(std::move(robot), of.frame()), target_(of.target()) {}

  std::string name() const override { return "orientation"; }
  int size() const override { return 3; }

  bool evaluate(const VectorView& x, Eigen::Ref<Eigen::VectorXd> value,
                Eigen::MatrixXd* J) const override {
    const Placed placed = place(x);
    const RotationError error(target_, placed.frame.rotation);
    value = error.phi;
    if (J != nullptr) {
      *J = -error.inverse * placed.J.bottomRows<3>();
    }
    return true;
  }

  void add_hessian(const VectorView& x, const VectorView& weights,
                   Eigen::MatrixXd& H) const override {
    const Placed placed = place(x);
    SmallMatrix curvature = SmallMatrix::Zero(x.size(), x.size());
    RotationError(target_, placed.frame.rotation)
        .add_hessian(robot(), placed.J, weights, curvature);
    H += curvature;
  }

 private:
  Eigen::Matrix3d target_;
};

class PoseTerm : public FrameTerm {
 public:
  PoseTerm(std::shared_ptr<const Chain> robot, const Pose& of)
      : FrameTerm(std::move(robot), of.frame()), target_(of.target()) {}

  std::string name() const override { return "pose"; }
  int size() const override { return 6; }

  bool evaluate(const VectorView& x, Eigen::Ref<Eigen::VectorXd> value,
                Eigen::MatrixXd* J) const override {
    const Placed placed = place(x);
    const RotationError error(target_.rotation, placed.frame.rotation);
    value.head<3>() = target_.translation - placed.point;
    value.tail<3>() = error.phi;
    if (J != nullptr) {
      *J = -placed.J;
      J->bottomRows<3>().noalias() = -error.inverse * placed.J.bottomRows<3>();
    }
    return true;
  }

  void add_hessian(const VectorView& x, const VectorView& weights,
                   Eigen::MatrixXd& H) const override {
    const Placed placed = place(x);
    Vector6 force = Vector6::Zero();
    force.head<3>() = -weights.head<3>();
    SmallMatrix curvature = SmallMatrix::Zero(x.size(), x.size());
    add_pose_curvature(robot(), placed.J, force, curvature);
    RotationError(target_.rotation, placed.frame.rotation)
        .add_hessian(robot(), placed.J, weights.tail<3>(), curvature);
    H += curvature;
  }

 private:
  SE3 target_;
};

}  // namespace

Pose::Pose(const SE3& target, std::string frame) : target_(target), frame_(std::move(frame)) {
  check_rotation(target.rotation);
  check_finite("target", target.translation);
}

Position::Position(const Eigen::Vector3d& target, std::string frame, const Eigen::Vector3d& point)
    : target_(target), frame_(std::move(frame)), point_(point) {
  check_finite("target", target);
  check_finite("point", point);
}

Orientation::Orientation(const Eigen::Matrix3d& target, std::string frame)
    : target_(target), frame_(std::move(frame)) {
  check_rotation(target);
}

std::shared_ptr<const Term> Pose::bind(const std::shared_ptr<const Chain>& robot) const {
  return std::make_shared<PoseTerm>(robot, *this);
}

std::shared_ptr<const Term> Position::bind(const std::shared_ptr<const Chain>& robot) const {
  return std::make_shared<PositionTerm>(robot, *this);
}

std::shared_ptr<const Term> Orientation::bind(const std::shared_ptr<const Chain>& robot) const {
  return std::make_shared<OrientationTerm>(robot, *this);
}

}  // namespace thing_kin::terms
