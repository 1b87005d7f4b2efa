#include "report.hpp"

#include <iomanip>

namespace bench {

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
  std::vector<Run> medians;
  for (const Run& run : runs) {
    // Without repetitions there is no median but the run itself.
    if (run.aggregate_name != "median" && run.repetitions > 1) {
      continue;
    }
    medians.push_back(run);
    const std::string& name = run.run_name.function_name;
    const auto slash = name.find('/');
    medians_[name.substr(0, slash)][name.substr(slash + 1)] = run.GetAdjustedCPUTime();
  }
  if (!medians.empty()) {
    ConsoleReporter::ReportRuns(medians);
  }
}

void RatioReporter::Finalize() {
  std::ostream& out = GetOutputStream();
  out << "\nmedian CPU time of the peer over thing_kin's: above 1 thing_kin is faster\n"
      << std::fixed;
  for (const auto& [work, medians] : medians_) {
    const auto ours = medians.find("thing_kin");
    if (ours == medians.end()) {
      continue;
    }
    for (const auto& [who, median] : medians) {
      if (who != ours->first) {
        out << std::left << std::setw(18) << work << std::setw(17) << who << std::right
            << std::setprecision(0) << std::setw(7) << median << " ns /" << std::setw(6)
            << ours->second << " ns = " << std::setprecision(2) << median / ours->second
            << (median < ours->second ? "  SLOWER than the peer\n" : "\n");
      }
    }
  }
  ConsoleReporter::Finalize();
}

}  // namespace bench
