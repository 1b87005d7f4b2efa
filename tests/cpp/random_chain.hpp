#pragma once

#include <numbers>
#include <random>
#include <vector>

#include "thing_kin/model/chain.hpp"

namespace thing_kin::test {

using Generator = std::mt19937;

inline double uniform(Generator& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}

/// 1 to 12 rows, of every joint type and constant, at least one joint.
inline std::vector<DhRow> random_rows(Generator& rng) {
  const int count = std::uniform_int_distribution<int>(1, 12)(rng);
  std::vector<DhRow> rows;
  for (int i = 0; i < count; ++i) {
    DhRow row;
    row.d = uniform(rng, -1, 1);
    row.theta = uniform(rng, -3, 3);
    row.a = uniform(rng, -1, 1);
    row.alpha = uniform(rng, -3, 3);
    row.joint = static_cast<JointType>(std::uniform_int_distribution<int>(0, 3)(rng));
    rows.push_back(row);
  }
  if (rows[0].joint == JointType::kFixed) {
    rows[0].joint = JointType::kRevolute;
  }
  return rows;
}

inline Chain random_chain(Generator& rng) { return Chain::from_dh(random_rows(rng)); }

inline Eigen::VectorXd random_vector(Generator& rng, Eigen::Index n, double bound = 3.0) {
  return Eigen::VectorXd::NullaryExpr(n, [&] { return uniform(rng, -bound, bound); });
}

}  // namespace thing_kin::test
