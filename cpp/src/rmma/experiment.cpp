#include "thing_kin/rmma/experiment.hpp"

#include <algorithm>

#include "thing_kin/core/parallel.hpp"
#include "thing_kin/core/random.hpp"

namespace thing_kin {

namespace {

constexpr std::uint64_t kSearchDraws = 0x5EA4C4;  // apart from what the world draws

ThesisMethod thesis_method(SearchMethod method) {
  switch (method) {
    case SearchMethod::kLinearKf:
      return ThesisMethod::kLinearKf;
    case SearchMethod::kUkf:
      return ThesisMethod::kUkf;
    case SearchMethod::kSpiral:
    case SearchMethod::kCovering:
      break;
  }
  return ThesisMethod::kSpiral;
}

}  // namespace

std::uint64_t drive_key(std::uint64_t seed, const DriveIndex& index) noexcept {
  return mix_keys(mix_keys(mix_keys(mix_bits(seed), index.velocity), index.run), index.side);
}

void run_once(const std::vector<SearchPoints>& sides, double velocity, const SearchOptions& options,
              std::uint64_t seed, const DriveIndex& index, const StartDrive& start,
              std::span<Attempt> attempts, std::vector<std::vector<SearchTrace>>* traces) {
  NoiseMemory memory;
  DriveIndex drive = index;
  auto out = attempts.begin();
  for (drive.side = 0; drive.side < sides.size(); ++drive.side) {
    const SearchPoints& side = sides[drive.side];
    SideOutcome outcome;
    outcome.trace = traces == nullptr ? nullptr : &traces->emplace_back();
    const std::unique_ptr<WorldRun> run = start(velocity, side, drive);
    if (options.method == SearchMethod::kCovering) {
      covering_search(*run, side, velocity, options.covering, memory, outcome);
    } else {
      thesis_search(*run, side, velocity, thesis_method(options.method), options.thesis,
                    mix_keys(drive_key(seed, drive), kSearchDraws), outcome);
    }
    out = std::ranges::copy(outcome.attempts, out).out;
  }
}

std::vector<Attempt> run_experiment(const std::vector<SearchPoints>& sides,
                                    std::span<const double> velocities, std::size_t runs,
                                    const SearchOptions& options, std::uint64_t seed,
                                    const StartDrive& start, int threads) {
  std::size_t fiducials = 0;
  for (const SearchPoints& side : sides) {
    fiducials += side.size();
  }
  std::vector<Attempt> attempts(velocities.size() * runs * fiducials);
  const auto work = [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      // Slow drives hold more than quick ones: every thread gets some of each.
      const DriveIndex index{.velocity = k % velocities.size(), .run = k / velocities.size()};
      const std::size_t row = index.velocity * runs + index.run;
      run_once(sides, velocities[index.velocity], options, seed, index, start,
               std::span(attempts).subspan(row * fiducials, fiducials));
    }
  };
  parallel_ranges(velocities.size() * runs, threads, 1, work);
  return attempts;
}

}  // namespace thing_kin
