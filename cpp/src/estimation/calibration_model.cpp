#include "thing_kin/estimation/calibration_model.hpp"

#include <Eigen/Geometry>

#include "calibration_reading.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin {

namespace {

using Part = CalibrationPart;

SE3 turn_about_y(double angle) {
  return {Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix(),
          Eigen::Vector3d::Zero()};
}

bool is_row(Part part) {
  return part == Part::kD || part == Part::kTheta || part == Part::kA || part == Part::kAlpha ||
         part == Part::kBeta;
}

}  // namespace

CalibrationModel::CalibrationModel(const Chain& chain,
                                   std::span<const CalibrationParameter> parameters)
    : chain_(chain), parameters_(parameters.begin(), parameters.end()) {
  const ChainDescription& description = chain_.description();
  std::size_t joint = 0;
  for (const Segment& segment : description.segments) {
    Link link;
    link.before = segment.before;
    link.after = link.row_after = segment.after;
    link.type = segment.type;
    if (segment.type != JointType::kFixed) {
      link.joint = description.order[joint++];
    }
    links_.push_back(link);
  }
  for (int i = 0; i < size(); ++i) {
    const CalibrationParameter& parameter = parameters_[static_cast<std::size_t>(i)];
    if (parameter.part == Part::kBase || parameter.part == Part::kTool ||
        parameter.part == Part::kOrigin) {
      motion_of(parameter.part, parameter.place).columns.emplace_back(i, parameter.axis);
    } else if (parameter.part != Part::kPoint) {
      links_[static_cast<std::size_t>(parameter.place)].own.push_back(i);
    }
  }
  screws_.resize(parameters_.size());
  joint_screws_.resize(static_cast<std::size_t>(chain.dof()));
}

CalibrationModel::Motion& CalibrationModel::motion_of(CalibrationPart part, int segment) {
  if (part == Part::kBase) {
    return base_motion_;
  }
  if (part == Part::kTool) {
    return tool_motion_;
  }
  int& origin = links_[static_cast<std::size_t>(segment)].origin;
  if (origin < 0) {
    origin = static_cast<int>(origins_.size());
    origins_.emplace_back();
  }
  return origins_[static_cast<std::size_t>(origin)];
}

void CalibrationModel::set(const CalibrationState& state) {
  state_ = state;
  const auto set_motion = [&](Motion& motion) {
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    motion.E.translation.setZero();
    for (const auto& [column, axis] : motion.columns) {
      (axis < 3 ? motion.E.translation[axis] : turn[axis - 3]) = state.values[column];
    }
    motion.E.rotation = so3_exp(turn);
    motion.turns = so3_left_jacobian(turn);
  };
  set_motion(base_motion_);
  set_motion(tool_motion_);
  for (Motion& motion : origins_) {
    set_motion(motion);
  }
  for (std::size_t s = 0; s < links_.size(); ++s) {
    set_row(s);
  }
  set_readings();
}

void CalibrationModel::set_readings() {
  gains_.setOnes(chain_.dof());
  offsets_.setZero(chain_.dof());
  compliances_.setZero(chain_.dof());
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const CalibrationParameter& parameter = parameters_[i];
    if (is_reading(parameter.part)) {
      Eigen::VectorXd& of = parameter.part == Part::kOffset  ? offsets_
                            : parameter.part == Part::kScale ? gains_
                                                             : compliances_;
      of[parameter.joint] += state_.values[static_cast<Eigen::Index>(i)];
    }
  }
}

void CalibrationModel::set_row(std::size_t s) {
  Link& link = links_[s];
  const Segment& segment = chain_.description().segments[s];
  double d = 0.0;
  double theta = 0.0;
  double a = 0.0;
  double alpha = 0.0;
  double beta = 0.0;
  bool any = false;
  for (const int i : link.own) {
    const Part part = parameters_[static_cast<std::size_t>(i)].part;
    const double value = state_.values[i];
    any = any || is_row(part);
    (part == Part::kD       ? d
     : part == Part::kTheta ? theta
     : part == Part::kA     ? a
     : part == Part::kAlpha ? alpha
                            : beta) += is_row(part) ? value : 0.0;
  }
  if (any) {
    const DhForm form = *dh_form(segment);
    link.row_after = dh_transform(form.d + d, form.theta + theta, form.a + a, form.alpha + alpha);
    link.after = beta == 0.0 ? link.row_after : link.row_after * turn_about_y(beta);
  }
}

Eigen::VectorXd CalibrationModel::readings(const VectorView& q, const VectorView& torques) const {
  Eigen::VectorXd reading = offsets_ + gains_.cwiseProduct(q);
  if (torques.size() > 0) {
    reading += compliances_.cwiseProduct(torques);
  }
  return reading;
}

Chain CalibrationModel::calibrated() const {
  ChainDescription description = chain_.description();
  for (std::size_t s = 0; s < links_.size(); ++s) {
    const Link& link = links_[s];
    Segment& segment = description.segments[s];
    double offset = 0.0;
    for (const int i : link.own) {
      offset +=
          parameters_[static_cast<std::size_t>(i)].part == Part::kOffset ? state_.values[i] : 0.0;
    }
    if (link.origin >= 0) {
      segment.before = segment.before * origins_[static_cast<std::size_t>(link.origin)].E;
    }
    SE3 shifted;
    move_joint(link.type, offset, shifted);
    segment.after = offset == 0.0 ? link.after : shifted * link.after;
  }
  return Chain(std::move(description));
}

CalibrationState CalibrationModel::recentered(const CalibrationState& state) const {
  CalibrationState centered = state;
  const auto motion = [&](const Motion& of) {
    Vector6 both = Vector6::Zero();
    for (const auto& [column, axis] : of.columns) {
      both[axis] = state.values[column];
      centered.values[column] = 0.0;
    }
    return SE3{so3_exp(both.tail<3>()), both.head<3>()};
  };
  centered.base = state.base * motion(base_motion_);
  centered.tool = motion(tool_motion_) * state.tool;
  return centered;
}

}  // namespace thing_kin
