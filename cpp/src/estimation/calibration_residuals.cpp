#include "thing_kin/estimation/calibration_residuals.hpp"

#include <Eigen/Geometry>

#include "thing_kin/lie/so3.hpp"
#include "thing_kin/linalg/spd.hpp"

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Error and its derivative by the tool's twist [linear; angular], both in world axes.
struct Measured {
  explicit Measured(Index rows) {
    error.setZero(rows);
    by_twist.setZero(rows, 6);
  }

  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1> error;
  Eigen::Matrix<double, Eigen::Dynamic, 6, 0, 6, 6> by_twist;
};

// error = [p_measured - p; log(R_measured R^T)]; exp(e) exp(-w) = exp(e - J_r^-1(e) w).
Measured pose_error_of(const SE3& tool, const SE3& measured) {
  Measured m(6);
  const Vector3d turn = so3_log(measured.rotation * tool.rotation.transpose());
  m.error.head<3>() = measured.translation - tool.translation;
  m.error.tail<3>() = turn;
  m.by_twist.topLeftCorner<3, 3>() = -Matrix3d::Identity();
  m.by_twist.bottomRightCorner<3, 3>() = -so3_right_jacobian_inverse(turn);
  return m;
}

Measured point_error_of(const SE3& tool, const Vector3d& point, const Vector3d& place) {
  Measured m(3);
  const Vector3d arm = tool.rotation * point;
  m.error = place - tool.translation - arm;
  m.by_twist.leftCols<3>() = -Matrix3d::Identity();
  m.by_twist.rightCols<3>() = skew(arm);
  return m;
}

// [X21]: a laser along the tool's z axis; the part of the way to the place that is across it.
Measured hit_error_of(const SE3& tool, const Vector3d& place) {
  Measured m(2);
  const Vector3d way = place - tool.translation;
  const Eigen::Matrix<double, 2, 3> across = tool.rotation.leftCols<2>().transpose();
  m.error = across * way;
  m.by_twist.leftCols<3>() = -across;
  m.by_twist.rightCols<3>() = across * skew(way);
  return m;
}

// L^-1 with L L^T = covariance, which is positive definite.
Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6> inverse_root(
    const MatrixView& covariance) {
  const Index m = covariance.rows();
  Eigen::MatrixXd L(m, m);
  cholesky(covariance, L);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6> inverse;
  inverse.setIdentity(m, m);
  for (Index i = 0; i < m; ++i) {
    for (Index k = 0; k < i; ++k) {
      inverse.row(i) -= L(i, k) * inverse.row(k);
    }
    inverse.row(i) /= L(i, i);
  }
  return inverse;
}

}  // namespace

int CalibrationData::rows() const { return kind == CalibrationKind::kPoses ? 6 : position_rows(); }

CalibrationResiduals::CalibrationResiduals(CalibrationModel& model, const CalibrationData& data,
                                           std::span<const int> postures)
    : model_(model), data_(data) {
  for (const int posture : postures) {
    for (int point = 0; point < data.per_posture(); ++point) {
      if (data.seen[static_cast<std::size_t>(posture * data.per_posture() + point)]) {
        blocks_.push_back({posture, point});
      }
    }
  }
}

const Eigen::VectorXd& CalibrationResiduals::torques_at(int posture) {
  if (data_.torques.size() > 0) {
    torques_ = data_.torques.col(posture);
  }
  return torques_;
}

Vector3d CalibrationResiduals::point_of(int point, const CalibrationState& state) const {
  Vector3d place = data_.points.col(point);
  for (Index i = model_.size() - 1; i >= 0; --i) {
    const CalibrationParameter& parameter = model_.parameters()[static_cast<std::size_t>(i)];
    if (parameter.part != CalibrationPart::kPoint) {
      break;  // points come last
    }
    if (parameter.place == point) {
      place[parameter.axis] += state.values[i];
    }
  }
  return place;
}

void CalibrationResiduals::errors(const CalibrationState& state, Eigen::VectorXd& e,
                                  RowMajorMatrix* D) {
  model_.set(state);
  const Index m = data_.rows();
  e.resize(rows());
  TwistColumns twists(6, size());
  int last = -1;
  SE3 tool;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const auto [posture, point] = blocks_[b];
    const auto at = static_cast<std::size_t>(posture * data_.per_posture() + point);
    if (posture != last) {
      tool = model_.tool(data_.q.col(posture), torques_at(posture),
                         D == nullptr ? nullptr : &twists, nullptr);
      last = posture;
    }
    const Vector3d place = data_.kind == CalibrationKind::kPoses
                               ? Vector3d::Zero().eval()
                               : data_.places.col(static_cast<Index>(at)).eval();
    const Measured measured = data_.kind == CalibrationKind::kPoses
                                  ? pose_error_of(tool, data_.poses[at])
                              : data_.kind == CalibrationKind::kPoints
                                  ? point_error_of(tool, point_of(point, state), place)
                                  : hit_error_of(tool, place);
    const Index row = static_cast<Index>(b) * m;
    e.segment(row, m) = measured.error;
    if (D != nullptr) {
      D->middleRows(row, m) = measured.by_twist.lazyProduct(twists);
      for (Index i = size() - 1; i >= 0; --i) {
        const CalibrationParameter& parameter = model_.parameters()[static_cast<std::size_t>(i)];
        if (parameter.part != CalibrationPart::kPoint) {
          break;
        }
        if (parameter.place == point) {
          D->col(i).segment(row, m) = -tool.rotation.col(parameter.axis);
        }
      }
    }
  }
}

void CalibrationResiduals::weigh(const CalibrationState& state, const CalibrationNoise& noise) {
  const Index m = data_.rows();
  const Index k = data_.position_rows();
  model_.set(state);
  TwistColumns joints(6, model_.chain().dof());
  const auto of = [](const std::vector<Eigen::MatrixXd>& all, std::size_t i) -> const auto& {
    return all[all.size() == 1 ? 0 : i];
  };
  whiteners_.resize(blocks_.size());
  is_diagonal_ = data_.covariances.empty() && data_.joint_covariances.empty();
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const auto [posture, point] = blocks_[b];
    const auto at = static_cast<std::size_t>(posture * data_.per_posture() + point);
    BlockMatrix covariance = BlockMatrix::Zero(m, m);
    if (data_.covariances.empty()) {
      covariance.diagonal().head(k).setConstant(noise.position * noise.position);
      covariance.diagonal().tail(m - k).setConstant(noise.rotation * noise.rotation);
      if (data_.joint_covariances.empty()) {
        whiteners_[b] = covariance.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
        continue;
      }
    } else {
      covariance = of(data_.covariances, at);
    }
    if (!data_.joint_covariances.empty()) {
      const SE3 tool = model_.tool(data_.q.col(posture), torques_at(posture), nullptr, &joints);
      const Measured measured = data_.kind == CalibrationKind::kPoses
                                    ? pose_error_of(tool, data_.poses[at])
                                : data_.kind == CalibrationKind::kPoints
                                    ? point_error_of(tool, point_of(point, state), Vector3d::Zero())
                                    : hit_error_of(tool, data_.places.col(static_cast<Index>(at)));
      const BlockRows by_joint = measured.by_twist.lazyProduct(joints);
      const BlockRows spread =
          by_joint.lazyProduct(of(data_.joint_covariances, static_cast<std::size_t>(posture)));
      covariance += spread.lazyProduct(by_joint.transpose());
    }
    whiteners_[b] = inverse_root(covariance);
  }
}

void CalibrationResiduals::evaluate(const CalibrationState& state, Eigen::VectorXd& r,
                                    RowMajorMatrix* J) {
  errors(state, r, J);
  const Index m = data_.rows();
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Index row = static_cast<Index>(b) * m;
    const BlockMatrix& W = whiteners_[b];
    if (is_diagonal_) {
      r.segment(row, m).array() *= W.diagonal().array();
      for (Index i = 0; J != nullptr && i < m; ++i) {
        J->row(row + i) *= W(i, i);
      }
      continue;
    }
    r.segment(row, m) = W.lazyProduct(r.segment(row, m)).eval();
    if (J != nullptr) {
      J->middleRows(row, m) = W.lazyProduct(J->middleRows(row, m)).eval();
    }
  }
}

}  // namespace thing_kin
