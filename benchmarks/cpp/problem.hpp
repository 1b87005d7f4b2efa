#pragma once

// What is timed, and the register in which the contenders enter.

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include "thing_kin/model/chain.hpp"

namespace bench {

inline constexpr std::size_t kInputs = 1024;  // different inputs, taken in turn

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix69 = Eigen::Matrix<double, 6, 9>;

/// The Thing with its base first, which is how every peer counts joints from the root, and the same
/// questions for all.
struct Problem {
  Problem();

  struct Input {
    Vector9 q;
    Matrix69 jacobian;          ///< of q
    thing_kin::SE3 T_goal;      ///< about two centimeters and a degree from the pose at q
    Eigen::Vector3d base_goal;  ///< about two centimeters and a degree from the base at q
    Eigen::Matrix<double, 6, 1> twist;
  };

  thing_kin::Chain robot;
  std::vector<Input> inputs;
};

const Problem& problem();

/// Answers of one contender for one work, for the checker.
struct Entry {
  std::string work;
  std::string who;
  std::function<Eigen::MatrixXd(const Problem::Input&)> answer;
};

std::vector<Entry>& entries();

/// Enters a contender. `run(input)` is what is timed, and returns or refers to its own kind of
/// result; `to_matrix(result)` makes it comparable.
template <typename Run, typename ToMatrix>
bool enter(const std::string& work, const std::string& who, Run run, ToMatrix to_matrix) {
  entries().push_back({work, who, [run, to_matrix](const Problem::Input& input) mutable {
                         return Eigen::MatrixXd(to_matrix(run(input)));
                       }});
  benchmark::RegisterBenchmark((work + "/" + who).c_str(), [run](benchmark::State& state) mutable {
    const std::vector<Problem::Input>& inputs = problem().inputs;
    std::size_t i = 0;
    for (auto _ : state) {
      auto&& result = run(inputs[i]);
      benchmark::DoNotOptimize(&result);
      benchmark::ClobberMemory();
      i = (i + 1) % kInputs;
    }
  });
  return true;
}

/// For results that are matrices already.
inline constexpr auto as_it_is = [](const auto& matrix) { return Eigen::MatrixXd(matrix); };

}  // namespace bench
