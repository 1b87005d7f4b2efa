#pragma once

// What the sources of PathSolver share.

#include <cstddef>

#include <Eigen/Core>

namespace thing_kin::path {

using ConstVector = Eigen::Map<const Eigen::VectorXd>;
using Vector = Eigen::Map<Eigen::VectorXd>;
using ConstMatrix = Eigen::Map<const Eigen::MatrixXd>;
using Matrix = Eigen::Map<Eigen::MatrixXd>;

inline constexpr double kGramDamping = 1e-11;     ///< of J J^T, whose trace is some 10
inline constexpr double kWorstDexterity = 30.0;   ///< log sqrt(kappa/M) is taken for no more
inline constexpr double kLeastBaseRadius = 1e-6;  ///< smaller base discs are points, m

constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }

}  // namespace thing_kin::path
