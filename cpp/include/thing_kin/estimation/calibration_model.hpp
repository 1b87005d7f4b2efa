#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "thing_kin/estimation/calibration_parameters.hpp"

namespace thing_kin {

/// Where base and tool stand and what the other parameters are. In `values` the parts of base and
/// tool are further motions E; recentered() makes them zero.
struct CalibrationState {
  SE3 base, tool;
  Eigen::VectorXd values;
};

/// Twists [linear; angular] of the tool, world axes, a column for each parameter.
using TwistColumns = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// A chain with parameters:
///
///     T = base E_base  prod_s before_s E_s joint_s(reading) after_s  E_tool tool,
///
/// with reading = (1 + scale) q + offset + compliance * torque and after_s from the row's d, theta,
/// a, alpha and beta where these are estimated. All derivatives are exact.
class CalibrationModel {
 public:
  CalibrationModel(const Chain& chain, std::span<const CalibrationParameter> parameters);

  int size() const { return static_cast<int>(parameters_.size()); }
  std::span<const CalibrationParameter> parameters() const { return parameters_; }
  const Chain& chain() const { return chain_; }

  /// From here on for these values.
  void set(const CalibrationState& state);

  /// The tool in the world. `torques` may be empty; so may `twists`, of size() columns, and
  /// `joint_twists`, of one a joint in the order of q. Columns of points are zero.
  SE3 tool(const VectorView& q, const VectorView& torques, TwistColumns* twists,
           TwistColumns* joint_twists);

  /// The chain with all that is geometry: offsets, rows, origins; neither scales nor sag.
  Chain calibrated() const;

  /// What the joints stand at where `q` is read.
  Eigen::VectorXd readings(const VectorView& q, const VectorView& torques) const;

  /// The same arm, with the motions E of base and tool in `base` and `tool`.
  CalibrationState recentered(const CalibrationState& state) const;

 private:
  // A turn about an axis through a point, or a slide along it.
  struct Screw {
    Eigen::Vector3d axis, point;
    bool is_turn = true;
    double factor = 1.0;
  };

  // A motion that is estimated: translation and rotation vector, with the turn's derivatives.
  struct Motion {
    SE3 E;
    Eigen::Matrix3d turns = Eigen::Matrix3d::Identity();
    std::vector<std::pair<int, int>> columns;  // parameter and axis
  };

  struct Link {
    SE3 before, after;
    SE3 row_after;  // after, without beta
    JointType type = JointType::kFixed;
    int joint = -1;        // in q
    int origin = -1;       // of motions_
    std::vector<int> own;  // parameters of joint and row
  };

  Motion& motion_of(CalibrationPart part, int segment);
  void set_row(std::size_t s);
  void set_readings();
  SE3 pass(Motion& motion, const SE3& frame);
  void pass_joint(const Link& link, const SE3& frame, const VectorView& q,
                  const VectorView& torques);
  void pass_row(const Link& link, const SE3& joint);
  void write_twists(const Eigen::Vector3d& tool, TwistColumns& twists) const;

  Chain chain_;
  std::vector<CalibrationParameter> parameters_;
  std::vector<Link> links_;
  std::vector<Motion> origins_;
  Motion base_motion_, tool_motion_;
  CalibrationState state_;
  Eigen::VectorXd gains_, offsets_, compliances_;  // of the joints' readings
  bool wants_screws_ = true;
  std::vector<Screw> screws_;        // of each parameter, at the last posture
  std::vector<Screw> joint_screws_;  // of each joint
};

}  // namespace thing_kin
