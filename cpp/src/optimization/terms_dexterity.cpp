#include "thing_kin/optimization/terms_dexterity.hpp"

#include <cmath>

#include "robot_term.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/log_dexterity.hpp"

namespace thing_kin::terms {

namespace {

Eigen::VectorXd weights_of(const Chain& robot, const Columns& columns) {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(robot.dof());
  if (const auto* given = std::get_if<ColumnWeights>(&columns)) {
    if (given->size() != robot.dof()) {
      throw InvalidArgument("jacobian", std::to_string(given->size()) + " weights",
                            std::to_string(robot.dof()) + ", one for each joint of the robot");
    }
    weights = *given;
  } else if (std::holds_alternative<Arm>(columns) && robot.base_joints()) {
    for (const int joint : *robot.base_joints()) {
      weights[joint] = 0.0;
    }
  }
  const auto counting = std::to_string((weights.array() > 0.0).count());
  if ((weights.array() > 0.0).count() < 6) {
    constexpr const char* kExpected = "at least 6, without which M is 0 everywhere";
    if (std::holds_alternative<ColumnWeights>(columns)) {
      throw InvalidArgument("jacobian", counting + " weights that are not zero", kExpected);
    }
    throw InvalidArgument(
        "robot", quoted(robot.name()) + " with " + counting + " joints that count", kExpected);
  }
  return weights;
}

}  // namespace

class DexterityMeasure::Bound : public FrameTerm {
 public:
  Bound(std::shared_ptr<const Chain> robot, const DexterityMeasure& of)
      : FrameTerm(std::move(robot), of.frame()),
        kind_(of.kind_),
        weights_(weights_of(this->robot(), of.columns())) {}

  std::string name() const override { return kind_.name; }
  int size() const override { return 1; }

  bool evaluate(const VectorView& x, Eigen::Ref<Eigen::VectorXd> value,
                Eigen::MatrixXd* J) const override {
    LogDexterity log;
    if (!logarithm(x, log)) {
      value[0] = 0.0;
      if (J != nullptr) {
        J->setZero(1, x.size());
      }
      return vanishes_where_singular();
    }
    value[0] = std::exp(kind_.sign * log.value);
    if (J != nullptr) {
      *J = kind_.sign * value[0] * log.gradient.transpose();
    }
    return true;
  }

  // f = exp(s L): f (s H_L + g g^T).
  void add_hessian(const VectorView& x, const VectorView& weights,
                   Eigen::MatrixXd& H) const override {
    LogDexterity log;
    if (logarithm(x, log)) {
      const double f = weights[0] * std::exp(kind_.sign * log.value);
      H += f * (kind_.sign * log.hessian + log.gradient * log.gradient.transpose());
    }
  }

 private:
  bool logarithm(const VectorView& x, LogDexterity& log) const {
    return log_dexterity(robot(), place(x).J, weights_.data(), log,
                         {kind_.condition_number, kind_.manipulability});
  }
  bool vanishes_where_singular() const { return kind_.sign < 0.0; }

  Kind kind_;
  Eigen::VectorXd weights_;
};

DexterityMeasure::DexterityMeasure(Kind kind, Columns columns, std::string frame)
    : kind_(kind), columns_(std::move(columns)), frame_(std::move(frame)) {
  if (const auto* weights = std::get_if<ColumnWeights>(&columns_)) {
    constexpr double kLargest = 1e6;  // a product of twelve does not overflow
    for (const double weight : *weights) {
      if (!(weight >= 0.0 && weight <= kLargest)) {
        throw InvalidArgument("jacobian", text(weight), "weights from 0 to 1e6");
      }
    }
  }
}

std::shared_ptr<const Term> DexterityMeasure::bind(
    const std::shared_ptr<const Chain>& robot) const {
  return std::make_shared<Bound>(robot, *this);
}

Manipulability::Manipulability(Columns columns, std::string frame)
    : DexterityMeasure({"manipulability", 0.0, 1.0, -1.0}, std::move(columns), std::move(frame)) {}

ConditionNumber::ConditionNumber(Columns columns, std::string frame)
    : DexterityMeasure({"condition_number", 1.0, 0.0, 1.0}, std::move(columns), std::move(frame)) {}

Dexterity::Dexterity(Columns columns, std::string frame)
    : DexterityMeasure({"dexterity", 0.5, 0.5, 1.0}, std::move(columns), std::move(frame)) {}

}  // namespace thing_kin::terms
