#pragma once

#include <limits>

#include <Eigen/Core>

#include "thing_kin/core/max_dof.hpp"

namespace thing_kin {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The most rows one task may have: a posture task has a row for each joint.
inline constexpr int kMaxTaskRows = kMaxDof;

/// A joint-space vector, (n).
using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxDof, 1>;

/// A geometric Jacobian, (6, n), rows [linear; angular].
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, kMaxDof>;

/// A vector of at most kMaxDof entries: a task error, singular values.
using SmallVector = JointVector;

/// A matrix of at most kMaxDof rows and columns: a task Jacobian, a basis, a projector.
using SmallMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxDof, kMaxDof>;

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Read-only views that take bounded and dynamic Eigen types alike, without a copy.
using VectorView = Eigen::Ref<const Eigen::VectorXd>;
using MatrixView = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

}  // namespace thing_kin
