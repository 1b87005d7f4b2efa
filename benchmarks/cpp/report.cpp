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
         "thing_kin uses the best instructions of this processor, thing_kin_<level> lower ones\n"
      << std::fixed;
  for (const auto& [work, medians] : medians_) {
    const auto ours = medians.find("thing_kin");
    if (ours == medians.end()) {
      continue;
    }
    for (const auto& [who, median] : medians) {
      if (who != ours->first) {
        const bool is_peer = who.rfind(ours->first, 0) != 0;  // or thing_kin at a lower level
        out << std::left << std::setw(23) << work << std::setw(19) << who << std::right
            << std::setprecision(1) << std::setw(8) << median << " ns /" << std::setw(8)
            << ours->second << " ns = " << std::setprecision(2) << median / ours->second
            << (is_peer && median < ours->second ? "  SLOWER than the peer\n" : "\n");
      }
    }
  }
  ConsoleReporter::Finalize();
}

}  // namespace bench
