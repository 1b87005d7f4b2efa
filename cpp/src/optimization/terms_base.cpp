#include "thing_kin/optimization/terms_base.hpp"

#include <array>

#include "robot_term.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::terms {

namespace {

/// A term of where the base's reference point is.
class BaseTerm : public RobotTerm {
 public:
  explicit BaseTerm(std::shared_ptr<const Chain> robot) : RobotTerm(std::move(robot)) {
    if (!this->robot().base_joints()) {
      throw InvalidArgument("robot", quoted(this->robot().name()).append(" without a base"),
                            "a robot on an omnidirectional base");
    }
    joints_ = {(*this->robot().base_joints())[0], (*this->robot().base_joints())[1]};
  }

 protected:
  Eigen::Vector2d position(const VectorView& q) const { return {q[joints_[0]], q[joints_[1]]}; }
  int joint(std::size_t axis) const { return joints_[axis]; }

 private:
  std::array<int, 2> joints_{};
};

class BaseDistanceTerm : public BaseTerm {
 public:
  BaseDistanceTerm(std::shared_ptr<const Chain> robot, Eigen::Vector2d center)
      : BaseTerm(std::move(robot)), center_(std::move(center)) {}

  std::string name() const override { return "base_distance"; }
  int size() const override { return 1; }

  bool evaluate(const VectorView& x, Eigen::Ref<Eigen::VectorXd> value,
                Eigen::MatrixXd* J) const override {
    const Eigen::Vector2d way = position(x) - center_;
    value[0] = way.norm();
    if (J != nullptr) {
      J->setZero(1, x.size());
      (*J)(0, joint(0)) = value[0] > 0.0 ? way[0] / value[0] : 1.0;
      (*J)(0, joint(1)) = value[0] > 0.0 ? way[1] / value[0] : 0.0;
    }
    return true;
  }

  void add_hessian(const VectorView& x, const VectorView& weights,
                   Eigen::MatrixXd& H) const override {
    const Eigen::Vector2d way = position(x) - center_;
    const double distance = way.norm();
    if (!(distance > 0.0)) {
      return;
    }
    const Eigen::Vector2d across = Eigen::Vector2d(-way[1], way[0]) / distance;
    for (const std::size_t i : {0U, 1U}) {
      for (const std::size_t k : {0U, 1U}) {
        H(joint(i), joint(k)) += weights[0] / distance * across[static_cast<Eigen::Index>(i)] *
                                 across[static_cast<Eigen::Index>(k)];
      }
    }
  }

 private:
  Eigen::Vector2d center_;
};

class BasePositionTerm : public BaseTerm {
 public:
  BasePositionTerm(std::shared_ptr<const Chain> robot, Eigen::Vector2d target)
      : BaseTerm(std::move(robot)), target_(std::move(target)) {}

  std::string name() const override { return "base_position"; }
  int size() const override { return 2; }

  bool evaluate(const VectorView& x, Eigen::Ref<Eigen::VectorXd> value,
                Eigen::MatrixXd* J) const override {
    value = target_ - position(x);
    if (J != nullptr) {
      J->setZero(2, x.size());
      (*J)(0, joint(0)) = -1.0;
      (*J)(1, joint(1)) = -1.0;
    }
    return true;
  }

  void add_hessian(const VectorView& /*x*/, const VectorView& /*weights*/,
                   Eigen::MatrixXd& /*H*/) const override {}

 private:
  Eigen::Vector2d target_;
};

}  // namespace

BaseDistance::BaseDistance(const Eigen::Vector2d& center) : center_(center) {
  check_finite("center", center);
}

BasePosition::BasePosition(const Eigen::Vector2d& target) : target_(target) {
  check_finite("target", target);
}

std::shared_ptr<const Term> BaseDistance::bind(const std::shared_ptr<const Chain>& robot) const {
  return std::make_shared<BaseDistanceTerm>(robot, center_);
}

std::shared_ptr<const Term> BasePosition::bind(const std::shared_ptr<const Chain>& robot) const {
  return std::make_shared<BasePositionTerm>(robot, target_);
}

}  // namespace thing_kin::terms
