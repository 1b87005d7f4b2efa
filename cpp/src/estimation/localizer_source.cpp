#include "thing_kin/estimation/localizer_source.hpp"

#include "thing_kin/core/chi_square.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

// The central 95 % of NIS, by the number of entries.
bool in_band(double nis, int dof) noexcept {
  static const std::array<std::array<double, 2>, 4> bands = [] {
    std::array<std::array<double, 2>, 4> band{};
    for (int k = 1; k <= 3; ++k) {
      band[static_cast<std::size_t>(k)] = {chi_square_quantile(0.025, k),
                                           chi_square_quantile(0.975, k)};
    }
    return band;
  }();
  const auto& [low, high] = bands[static_cast<std::size_t>(dof)];
  return low <= nis && nis <= high;
}

}  // namespace

void NisStatistics::add(const PoseVerdict& verdict) noexcept {
  if (verdict.dof == 0) {
    return;
  }
  ++count;
  sum += verdict.nis;
  dof += verdict.dof;
  within += in_band(verdict.nis, verdict.dof) ? 1 : 0;
}

void NisStatistics::add(const NisStatistics& other) noexcept {
  count += other.count;
  sum += other.sum;
  dof += other.dof;
  within += other.within;
}

void SourceCounts::add(const PoseVerdict& verdict, bool twist) noexcept {
  if (!verdict.accepted) {
    ++rejected;
    return;
  }
  ++accepted;
  (twist ? twists : poses).add(verdict);
}

void LocalizerSource::set_gate(double probability) {
  if (!(probability > 0.0 && probability <= 1.0)) {
    throw InvalidArgument("gate", text(probability), "a probability, 0 < gate <= 1");
  }
  gate = probability;
  for (int dof = 1; dof <= 3; ++dof) {
    bound[static_cast<std::size_t>(dof)] = chi_square_quantile(probability, dof);
  }
}

}  // namespace thing_kin
