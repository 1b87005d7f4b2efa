// thing_kin beside its peers: checks all answers, then times them in random turns.

#include <algorithm>
#include <iostream>

#include <sched.h>

#include "problem.hpp"
#include "report.hpp"

namespace {

// Largest difference from thing_kin's answer, relative where that is large.
double difference(const Eigen::MatrixXd& expected, const Eigen::MatrixXd& got) {
  if (got.rows() != expected.rows() || got.cols() != expected.cols() || !got.allFinite()) {
    return 1.0;
  }
  return (got - expected).cwiseAbs().maxCoeff() / std::max(1.0, expected.cwiseAbs().maxCoeff());
}

bool all_agree() {
  bool agree = true;
  const auto& entries = bench::entries();
  for (const bench::Entry& peer : entries) {
    const auto ours = std::find_if(entries.begin(), entries.end(), [&](const bench::Entry& e) {
      return e.work == peer.work && e.who == "thing_kin";
    });
    double worst = 0.0;
    for (std::size_t i = 0; i < peer.questions; ++i) {
      worst = std::max(worst, difference(ours->answer(i), peer.answer(i)));
    }
    if (worst > 1e-9) {
      std::cerr << peer.work << "/" << peer.who << " differs from thing_kin by " << worst << "\n";
      agree = false;
    }
  }
  return agree;
}

void pin_to_one_cpu() {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(sched_getcpu(), &set);
  sched_setaffinity(0, sizeof(set), &set);  // where it is not allowed, times scatter more
}

}  // namespace

int main(int argc, char** argv) {
  if (!all_agree()) {
    return 1;
  }
  pin_to_one_cpu();
  // Defaults; what the user gives comes later and wins.
  std::vector<std::string> defaults{
      "--benchmark_enable_random_interleaving=true", "--benchmark_repetitions=9",
      "--benchmark_report_aggregates_only=true", "--benchmark_min_time=0.05"};
  std::vector<char*> arguments{argv[0]};
  for (std::string& option : defaults) {
    arguments.push_back(option.data());
  }
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) {
    return 2;
  }
  benchmark::AddCustomContext("simd_level", thing_kin::to_string(bench::best()));
  bench::RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
