#include "thing_kin/optimization/terms_clearance.hpp"

#include "robot_term.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::terms {

namespace {

class ClearanceTerm : public RobotTerm {
 public:
  ClearanceTerm(std::shared_ptr<const Chain> robot, const Clearance& of)
      : RobotTerm(std::move(robot)), clearances_(this->robot(), of.spheres(), of.obstacles()) {}

  std::string name() const override { return "clearance"; }
  int size() const override { return clearances_.size(); }
  std::string describe(int entry) const override { return clearances_.describe(entry); }

  bool evaluate(const VectorView& x, Eigen::Ref<Eigen::VectorXd> value,
                Eigen::MatrixXd* J) const override {
    Posture posture;
    place_joints(robot(), x.data(), posture);
    if (J != nullptr) {
      J->resize(size(), x.size());
    }
    JointVector gradient;
    for (int i = 0; i < size(); ++i) {
      if (J == nullptr) {
        value[i] = clearances_.value(posture, x.data(), i);
      } else {
        value[i] = clearances_.gradient(posture, x.data(), i, gradient);
        J->row(i) = gradient.transpose();
      }
    }
    return true;
  }

  void add_hessian(const VectorView& x, const VectorView& weights,
                   Eigen::MatrixXd& H) const override {
    Posture posture;
    place_joints(robot(), x.data(), posture);
    SmallMatrix sum = SmallMatrix::Zero(x.size(), x.size());
    for (int i = 0; i < size(); ++i) {
      if (weights[i] != 0.0) {
        clearances_.add_hessian(posture, x.data(), i, weights[i], sum);
      }
    }
    H += sum;
  }

 private:
  Clearances clearances_;
};

}  // namespace

Clearance::Clearance(LinkSpheres spheres, std::vector<Obstacle> obstacles, bool self_collision)
    : spheres_(std::move(spheres)), obstacles_(std::move(obstacles)) {
  if (!self_collision) {
    spheres_.pairs.clear();
  }
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    const std::string name = std::string("obstacles[").append(std::to_string(i)).append("]");
    check(obstacles_[i], name + ".");
    if (spheres_.spheres.empty() && !std::holds_alternative<Disc>(obstacles_[i])) {
      throw InvalidArgument("spheres", "none, with " + name + " that is no Disc",
                            "LinkSpheres, which can meet it");
    }
  }
}

std::shared_ptr<const Term> Clearance::bind(const std::shared_ptr<const Chain>& robot) const {
  return std::make_shared<ClearanceTerm>(robot, *this);
}

}  // namespace thing_kin::terms
