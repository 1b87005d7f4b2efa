#pragma once

// What is timed, and the register in which the contenders enter.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include "thing_kin/core/simd.hpp"
#include "thing_kin/model/chain.hpp"

namespace bench {

inline constexpr std::size_t kInputs = 1024;  // different inputs, taken in turn
inline constexpr std::size_t kRows = 10'000;  // of a batch

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix69 = Eigen::Matrix<double, 6, 9>;

/// The Thing with its base first, which is how every peer counts joints from the root, and the same
/// questions for all.
struct Problem {
  Problem();

  struct Input {
    Vector9 q;
    Vector9 qd;
    Matrix69 jacobian;          ///< of q
    thing_kin::SE3 T_goal;      ///< about two centimeters and a degree from the pose at q
    Eigen::Vector3d base_goal;  ///< about two centimeters and a degree from the base at q
    Eigen::Matrix<double, 6, 1> twist;
  };

  thing_kin::Chain robot;
  std::vector<Input> inputs;
  std::vector<double> rows;  ///< (kRows, 9), row-major

  const double* row(std::size_t i) const { return rows.data() + 9 * i; }
};

const Problem& problem();

/// Answers of one contender for one work, for the checker.
struct Entry {
  std::string work;
  std::string who;
  std::size_t questions;
  std::function<Eigen::MatrixXd(std::size_t)> answer;
};

std::vector<Entry>& entries();

/// The instructions that thing_kin's kernels use; peers do not care.
using Level = thing_kin::SimdLevel;

inline Level best() { return thing_kin::best_simd_level(); }

/// Those of this processor, the best first.
std::vector<Level> levels();

/// "thing_kin" for the best level, "thing_kin_<level>" for the others.
std::string name_of(Level level);

/// Enters a contender. `run(input)` is what is timed, and returns or refers to its own kind of
/// result; `to_matrix(result)` makes it comparable.
template <typename Run, typename ToMatrix>
bool enter(const std::string& work, const std::string& who, Run run, ToMatrix to_matrix,
           Level level = best()) {
  entries().push_back({work, who, kInputs, [=](std::size_t i) mutable {
                         thing_kin::use_simd_level(level);
                         return Eigen::MatrixXd(to_matrix(run(problem().inputs[i])));
                       }});
  benchmark::RegisterBenchmark((work + "/" + who).c_str(), [=](benchmark::State& state) mutable {
    thing_kin::use_simd_level(level);
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

/// As enter(), for `run()` that answers all of Problem::rows; times are those of one row.
template <typename Run, typename ToMatrix>
bool enter_batch(const std::string& work, const std::string& who, Run run, ToMatrix to_matrix,
                 Level level = best()) {
  entries().push_back({work, who, 1, [=](std::size_t) mutable {
                         thing_kin::use_simd_level(level);
                         return Eigen::MatrixXd(to_matrix(run()));
                       }});
  benchmark::RegisterBenchmark((work + "/" + who).c_str(), [=](benchmark::State& state) mutable {
    thing_kin::use_simd_level(level);
    while (state.KeepRunningBatch(kRows)) {
      auto&& result = run();
      benchmark::DoNotOptimize(&result);
      benchmark::ClobberMemory();
    }
  });
  return true;
}

/// For results that are matrices already.
inline constexpr auto as_it_is = [](const auto& matrix) { return Eigen::MatrixXd(matrix); };

}  // namespace bench
