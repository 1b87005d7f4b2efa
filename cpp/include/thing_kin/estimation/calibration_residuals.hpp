#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "thing_kin/estimation/calibration_model.hpp"

namespace thing_kin {

enum class CalibrationKind : std::uint8_t {
  kPoses,   ///< of the tool in the world: error of position, then rotation vector, world axes
  kPoints,  ///< places in the world of points of the tool: error in world axes
  kHits,  ///< places in the world that the tool's z axis was led through: error in the tool's x, y
};

/// What was measured. Columns are postures; for points there are `points.cols()` measurements a
/// posture, one after the other.
struct CalibrationData {
  CalibrationKind kind = CalibrationKind::kPoses;
  Eigen::MatrixXd q;                                       ///< (dof, N)
  Eigen::MatrixXd torques;                                 ///< (dof, N), for sag; or empty
  std::vector<SE3> poses;                                  ///< of kPoses
  Eigen::Matrix3Xd places;                                 ///< of kPoints and kHits
  std::vector<bool> seen;                                  ///< of each measurement
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 1);  ///< in the tool, nominal
  /// Of a measurement: one for all or one each; empty: unknown.
  std::vector<Eigen::MatrixXd> covariances;
  /// Of the joints' readings, (dof, dof): one for all or one a posture; empty: exact.
  std::vector<Eigen::MatrixXd> joint_covariances;

  int postures() const { return static_cast<int>(q.cols()); }
  int per_posture() const {
    return kind == CalibrationKind::kPoints ? static_cast<int>(points.cols()) : 1;
  }
  /// Rows of one measurement; the first three (two of a hit) are of position.
  int rows() const;
  int position_rows() const { return kind == CalibrationKind::kHits ? 2 : 3; }
};

/// Standard deviations of a measurement's position (m) and rotation (rad), where no covariance is
/// given.
struct CalibrationNoise {
  double position = 1e-3;
  double rotation = 1e-3;
};

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Residuals of the measurements of some postures, with derivatives by all parameters.
class CalibrationResiduals {
 public:
  /// A measurement: point `point` at posture `posture`.
  struct Block {
    int posture = 0;
    int point = 0;
  };

  /// Both must outlive this.
  CalibrationResiduals(CalibrationModel& model, const CalibrationData& data,
                       std::span<const int> postures);

  std::span<const Block> blocks() const { return blocks_; }
  int rows() const { return static_cast<int>(blocks_.size()) * data_.rows(); }
  int size() const { return model_.size(); }
  const CalibrationData& data() const { return data_; }

  /// Errors as they are, m and rad; `D`, of rows() by size(), may be null.
  void errors(const CalibrationState& state, Eigen::VectorXd& e, RowMajorMatrix* D);

  /// What errors are divided by from here on: the measurements' covariances with, at the state,
  /// what the joints' add to them.
  void weigh(const CalibrationState& state, const CalibrationNoise& noise);

  /// The errors in standard deviations.
  void evaluate(const CalibrationState& state, Eigen::VectorXd& r, RowMajorMatrix* J);

 private:
  const Eigen::VectorXd& torques_at(int posture);
  Eigen::Vector3d point_of(int point, const CalibrationState& state) const;

  CalibrationModel& model_;
  const CalibrationData& data_;
  std::vector<Block> blocks_;
  std::vector<Matrix6> whiteners_;  // of which a measurement's rows count
  bool is_diagonal_ = true;         // all of these
  Eigen::VectorXd torques_;
};

}  // namespace thing_kin
