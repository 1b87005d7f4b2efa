// The chain of a CalibrationModel from base to tool, and each parameter's twist.

#include <Eigen/Geometry>

#include "calibration_reading.hpp"
#include "thing_kin/estimation/calibration_model.hpp"

namespace thing_kin {

namespace {

using Part = CalibrationPart;

}  // namespace

SE3 CalibrationModel::pass(Motion& motion, const SE3& frame) {
  const SE3 moved = frame * motion.E;
  if (!wants_screws_) {
    return moved;
  }
  for (const auto& [column, axis] : motion.columns) {
    Screw& screw = screws_[static_cast<std::size_t>(column)];
    screw.is_turn = axis >= 3;
    screw.axis = screw.is_turn ? frame.rotation * motion.turns.col(axis - 3)
                               : Eigen::Vector3d(frame.rotation.col(axis));
    screw.point = moved.translation;
  }
  return moved;
}

void CalibrationModel::pass_joint(const Link& link, const SE3& frame, const VectorView& q,
                                  const VectorView& torques) {
  Screw screw{frame.rotation.col(2), frame.translation, is_rotary(link.type), 1.0};
  for (const int i : link.own) {
    const auto k = static_cast<std::size_t>(i);
    const Part part = parameters_[k].part;
    if (is_reading(part)) {
      const double torque = torques.size() > 0 ? torques[link.joint] : 0.0;
      screw.factor = part == Part::kScale ? q[link.joint] : part == Part::kSag ? torque : 1.0;
      screws_[k] = screw;
    } else if (part == Part::kTheta || part == Part::kD) {
      screws_[k] = {screw.axis, screw.point, part == Part::kTheta, 1.0};
    }
  }
  screw.factor = 1.0;
  joint_screws_[static_cast<std::size_t>(link.joint)] = screw;
}

void CalibrationModel::pass_row(const Link& link, const SE3& joint) {
  const SE3 end = joint * link.row_after;
  for (const int i : link.own) {
    const auto k = static_cast<std::size_t>(i);
    const Part part = parameters_[k].part;
    if (part == Part::kA || part == Part::kAlpha || part == Part::kBeta) {
      const Eigen::Vector3d axis = end.rotation.col(part == Part::kBeta ? 1 : 0);
      screws_[k] = {axis, end.translation, part != Part::kA, 1.0};
    }
  }
}

SE3 CalibrationModel::tool(const VectorView& q, const VectorView& torques, TwistColumns* twists,
                           TwistColumns* joint_twists) {
  const Eigen::VectorXd reading = readings(q, torques);
  wants_screws_ = twists != nullptr || joint_twists != nullptr;
  SE3 T = pass(base_motion_, state_.base);
  for (const Link& link : links_) {
    T = T * link.before;
    if (link.origin >= 0) {
      T = pass(origins_[static_cast<std::size_t>(link.origin)], T);
    }
    if (link.type != JointType::kFixed) {
      if (wants_screws_) {
        pass_joint(link, T, q, torques);
      }
      move_joint(link.type, reading[link.joint], T);
      if (wants_screws_) {
        pass_row(link, T);
      }
    }
    T = T * link.after;
  }
  T = pass(tool_motion_, T) * state_.tool;
  if (twists != nullptr) {
    write_twists(T.translation, *twists);
  }
  if (joint_twists != nullptr) {
    for (std::size_t j = 0; j < joint_screws_.size(); ++j) {
      const Screw& screw = joint_screws_[j];
      auto column = joint_twists->col(static_cast<Eigen::Index>(j));
      column.head<3>() =
          screw.is_turn ? screw.axis.cross(T.translation - screw.point).eval() : screw.axis;
      column.tail<3>() = screw.is_turn ? screw.axis : Eigen::Vector3d::Zero().eval();
    }
  }
  return T;
}

void CalibrationModel::write_twists(const Eigen::Vector3d& tool, TwistColumns& twists) const {
  for (std::size_t i = 0; i < screws_.size(); ++i) {
    auto column = twists.col(static_cast<Eigen::Index>(i));
    const Screw& screw = screws_[i];
    if (parameters_[i].part == Part::kPoint) {
      column.setZero();
    } else if (screw.is_turn) {
      column.head<3>() = screw.factor * screw.axis.cross(tool - screw.point);
      column.tail<3>() = screw.factor * screw.axis;
    } else {
      column.head<3>() = screw.factor * screw.axis;
      column.tail<3>().setZero();
    }
  }
}

}  // namespace thing_kin
