#include "thing_kin/optimization/terms_joints.hpp"

#include <cmath>

#include "robot_term.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/model/joint_difference.hpp"

namespace thing_kin::terms {

namespace {

/// sum_i w_i (q_i - c_i)^2.
class SquaresTerm : public Term {
 public:
  /// Without a robot the differences are plain.
  SquaresTerm(const char* name, std::shared_ptr<const Chain> robot, Eigen::VectorXd center,
              Eigen::VectorXd weights)
      : name_(name),
        robot_(std::move(robot)),
        center_(std::move(center)),
        weights_(std::move(weights)) {}

  std::string name() const override { return name_; }
  int size() const override { return 1; }
  int variables() const override { return static_cast<int>(center_.size()); }

  bool evaluate(const VectorView& x, Eigen::Ref<Eigen::VectorXd> value,
                Eigen::MatrixXd* J) const override {
    Eigen::VectorXd way = x - center_;
    if (robot_ != nullptr) {
      joint_difference(*robot_, center_.data(), x.data(), way.data());
    }
    const Eigen::VectorXd weighted = weights_.cwiseProduct(way);
    value[0] = weighted.dot(way);
    if (J != nullptr) {
      *J = 2.0 * weighted.transpose();
    }
    return true;
  }

  void add_hessian(const VectorView& /*x*/, const VectorView& weights,
                   Eigen::MatrixXd& H) const override {
    H.diagonal() += 2.0 * weights[0] * weights_;
  }

 private:
  const char* name_;
  std::shared_ptr<const Chain> robot_;
  Eigen::VectorXd center_;
  Eigen::VectorXd weights_;
};

}  // namespace

SeedDistance::SeedDistance(Eigen::VectorXd seed, Eigen::VectorXd weights)
    : seed_(std::move(seed)), weights_(std::move(weights)) {
  check_finite("seed", seed_);
  if (weights_.size() == 0) {
    weights_ = Eigen::VectorXd::Ones(seed_.size());
  }
  check_finite("weights", weights_);
  if (weights_.size() != seed_.size()) {
    throw InvalidArgument("weights", std::to_string(weights_.size()) + " numbers",
                          std::to_string(seed_.size()) + ", as many as seed");
  }
  if ((weights_.array() < 0.0).any()) {
    throw InvalidArgument("weights", "a negative number", "numbers of at least 0");
  }
}

std::shared_ptr<const Term> SeedDistance::bind(const std::shared_ptr<const Chain>& robot) const {
  if (robot != nullptr && robot->dof() != seed_.size()) {
    throw InvalidArgument("seed", std::to_string(seed_.size()) + " numbers",
                          std::to_string(robot->dof()) + ", one for each joint of the robot");
  }
  return std::make_shared<SquaresTerm>("seed_distance", robot, seed_, weights_);
}

std::shared_ptr<const Term> JointCentering::bind(const std::shared_ptr<const Chain>& robot) const {
  if (robot == nullptr) {
    throw InvalidArgument("robot", "none", "a robot, which this term is about");
  }
  const int n = robot->dof();
  Eigen::VectorXd middle = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(n);
  for (int i = 0; i < n; ++i) {
    const double range = robot->upper()[i] - robot->lower()[i];
    if (std::isfinite(range) && range > 0.0) {
      middle[i] = robot->lower()[i] + 0.5 * range;
      weights[i] = 1.0 / (range * range);
    }
  }
  return std::make_shared<SquaresTerm>("joint_centering", robot, middle, weights);
}

}  // namespace thing_kin::terms
