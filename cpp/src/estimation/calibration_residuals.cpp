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
// Rows beyond the measurement's are zero.
struct Measured {
  Vector6 error = Vector6::Zero();
  Matrix6 by_twist = Matrix6::Zero();
};

// error = [p_measured - p; log(R_measured R^T)]; exp(e) exp(-w) = exp(e - J_r^-1(e) w).
Measured pose_error_of(const SE3& tool, const SE3& measured) {
  Measured m;
  const Vector3d turn = so3_log(measured.rotation * tool.rotation.transpose());
  m.error.head<3>() = measured.translation - tool.translation;
  m.error.tail<3>() = turn;
  m.by_twist.topLeftCorner<3, 3>() = -Matrix3d::Identity();
  m.by_twist.bottomRightCorner<3, 3>() = -so3_right_jacobian_inverse(turn);
  return m;
}

Measured point_error_of(const SE3& tool, const Vector3d& point, const Vector3d& place) {
  Measured m;
  const Vector3d arm = tool.rotation * point;
  m.error.head<3>() = place - tool.translation - arm;
  m.by_twist.topLeftCorner<3, 3>() = -Matrix3d::Identity();
  m.by_twist.topRightCorner<3, 3>() = skew(arm);
  return m;
}

// [X21]: a laser along the tool's z axis; the part of the way to the place that is across it.
Measured hit_error_of(const SE3& tool, const Vector3d& place) {
  Measured m;
  const Vector3d way = place - tool.translation;
  const Eigen::Matrix<double, 2, 3> across = tool.rotation.leftCols<2>().transpose();
  m.error.head<2>() = across * way;
  m.by_twist.topLeftCorner<2, 3>() = -across;
  m.by_twist.topRightCorner<2, 3>() = across * skew(way);
  return m;
}

// L^-1 with L L^T = the first m rows and columns of the covariance, which are positive definite.
Matrix6 inverse_root(const Matrix6& covariance, Index m) {
  Matrix6 L = covariance;
  cholesky(MatrixView(covariance.topLeftCorner(m, m)), MatrixSpan(L.topLeftCorner(m, m)));
  Matrix6 inverse = Matrix6::Identity();
  for (Index i = 0; i < m; ++i) {
    for (Index k = 0; k < i; ++k) {
      inverse.row(i) -= L(i, k) * inverse.row(k);
    }
    inverse.row(i) /= L(i, i);
  }
  return inverse;
}

// Measurement `at`; `point`: on the tool.
Measured measured_at(const CalibrationData& data, std::size_t at, const SE3& tool,
                     const Vector3d& point) {
  if (data.kind == CalibrationKind::kPoses) {
    return pose_error_of(tool, data.poses[at]);
  }
  const Vector3d place = data.places.col(static_cast<Index>(at));
  return data.kind == CalibrationKind::kPoints ? point_error_of(tool, point, place)
                                               : hit_error_of(tool, place);
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
    const Measured measured = measured_at(data_, at, tool, point_of(point, state));
    const Index row = static_cast<Index>(b) * m;
    e.segment(row, m) = measured.error.head(m);
    if (D != nullptr) {
      for (Index i = 0; i < size(); ++i) {
        const Vector6 column = measured.by_twist * twists.col(i);
        D->col(i).segment(row, m) = column.head(m);
      }
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
    Matrix6 covariance = Matrix6::Zero();
    if (data_.covariances.empty()) {
      covariance.diagonal().head(k).setConstant(noise.position * noise.position);
      covariance.diagonal().segment(k, m - k).setConstant(noise.rotation * noise.rotation);
      if (is_diagonal_) {
        whiteners_[b].setIdentity();
        whiteners_[b].diagonal().head(m) = covariance.diagonal().head(m).cwiseSqrt().cwiseInverse();
        continue;
      }
    } else {
      covariance.topLeftCorner(m, m) = of(data_.covariances, at);
    }
    if (!data_.joint_covariances.empty()) {
      const SE3 tool = model_.tool(data_.q.col(posture), torques_at(posture), nullptr, &joints);
      const Matrix6 by_twist = measured_at(data_, at, tool, point_of(point, state)).by_twist;
      const TwistColumns by_joint = by_twist.lazyProduct(joints);
      const TwistColumns spread =
          by_joint.lazyProduct(of(data_.joint_covariances, static_cast<std::size_t>(posture)));
      covariance += spread.lazyProduct(by_joint.transpose());
    }
    whiteners_[b] = inverse_root(covariance, m);
  }
}

void CalibrationResiduals::evaluate(const CalibrationState& state, Eigen::VectorXd& r,
                                    RowMajorMatrix* J) {
  errors(state, r, J);
  const Index m = data_.rows();
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Index first = static_cast<Index>(b) * m;
    const Matrix6& W = whiteners_[b];  // lower triangular: rows from the last on, in place
    for (Index i = m - 1; i >= 0; --i) {
      r[first + i] *= W(i, i);
      for (Index k = 0; k < i && !is_diagonal_; ++k) {
        r[first + i] += W(i, k) * r[first + k];
      }
      if (J != nullptr) {
        J->row(first + i) *= W(i, i);
        for (Index k = 0; k < i && !is_diagonal_; ++k) {
          J->row(first + i) += W(i, k) * J->row(first + k);
        }
      }
    }
  }
}

}  // namespace thing_kin
