#pragma once

#include "thing_kin/core/random.hpp"
#include "thing_kin/search/spiral.hpp"

namespace thing_kin {

struct StochasticOptions {
  double sample_gap = 0.0;  ///< m: pitch of the grid, > 0
  std::size_t count = 200;  ///< draws, > 0
  std::size_t keep = 50;    ///< points at most, > 0
};

/// Draws from N(center, covariance), [X21] (2.1), brought to a grid about the center along the
/// axes, each cell once, the most probable first (ties by x, then y); the center is always the
/// first. The covariance may be singular. Throws InvalidArgument naming what is wrong.
SearchPoints stochastic_points(const Eigen::Vector2d& center, const Eigen::Matrix2d& covariance,
                               const StochasticOptions& options, RandomStream& random);

}  // namespace thing_kin
