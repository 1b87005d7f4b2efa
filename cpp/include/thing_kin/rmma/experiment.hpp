#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "thing_kin/rmma/covering_search.hpp"
#include "thing_kin/rmma/thesis_search.hpp"
#include "thing_kin/rmma/world.hpp"

namespace thing_kin {

enum class SearchMethod : std::uint8_t { kSpiral, kLinearKf, kUkf, kCovering };

struct SearchOptions {
  SearchMethod method = SearchMethod::kSpiral;
  ThesisOptions thesis;
  CoveringDriveOptions covering;
};

/// Which drive: everything random hangs on it and on the seed.
struct DriveIndex {
  std::uint64_t velocity = 0, run = 0, side = 0;
};

/// The key of what the world does in a drive; independent of the method, which so meets the same
/// world as the others.
std::uint64_t drive_key(std::uint64_t seed, const DriveIndex& index) noexcept;

/// Makes the world of one drive.
using StartDrive = std::function<std::unique_ptr<WorldRun>(
    double velocity, const SearchPoints& side, const DriveIndex& index)>;

/// One run: all sides, one after the other. `attempts`: of the fiducials of all sides.
void run_once(const std::vector<SearchPoints>& sides, double velocity, const SearchOptions& options,
              std::uint64_t seed, const DriveIndex& index, const StartDrive& start,
              std::span<Attempt> attempts, std::vector<std::vector<SearchTrace>>* traces = nullptr);

/// attempts[velocity][run][fiducial]. The same whatever the number of threads; with more than one
/// `start` is called from all of them.
std::vector<Attempt> run_experiment(const std::vector<SearchPoints>& sides,
                                    std::span<const double> velocities, std::size_t runs,
                                    const SearchOptions& options, std::uint64_t seed,
                                    const StartDrive& start, int threads);

}  // namespace thing_kin
