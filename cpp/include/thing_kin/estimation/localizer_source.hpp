#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "thing_kin/estimation/twist_track.hpp"

namespace thing_kin {

/// Variables by name, bits 0..2 those of a pose, 3..5 those of a twist.
enum FuseBit : std::uint8_t { kFuseX = 1, kFuseTheta = 4, kFuseVx = 8, kFuseOmega = 32 };
inline constexpr std::uint8_t kFuseAll = 63;
inline constexpr std::array<const char*, 6> kFuseNames{"x", "y", "theta", "vx", "vy", "omega"};

/// What a source's accepted measurements say of their covariances: NIS is the squared innovation in
/// units of its covariance, its expectation the number of entries.
struct NisStatistics {
  long count = 0;  ///< measurements that there was something to compare with
  double sum = 0.0;
  long dof = 0;     ///< sum of their entries
  long within = 0;  ///< those in their central 95 % band

  void add(const PoseVerdict& verdict) noexcept;
  void add(const NisStatistics& other) noexcept;
};

/// Final verdicts. Poses and twists apart, so that sums are taken in order of time.
struct SourceCounts {
  long accepted = 0;
  long rejected = 0;
  NisStatistics poses;
  NisStatistics twists;

  void add(const PoseVerdict& verdict, bool twist) noexcept;
};

/// A named source of measurements: what of them counts, and what came of them.
struct LocalizerSource {
  std::string name;
  std::uint8_t fuse = kFuseAll;
  std::optional<Eigen::Matrix3d> covariance;  ///< where a measurement brings none
  double gate = 1.0;                          ///< a probability
  bool gates_twists = false;                  ///< the gate is its own, not the localizer's
  NisBound bound{};
  TwistTrack track;
  SourceCounts folded;  ///< of what is older than the history
  long refused = 0;     ///< too old when it came

  /// Throws InvalidArgument("gate", ...) unless 0 < gate <= 1.
  void set_gate(double probability);
  std::uint8_t pose_mask() const noexcept { return fuse & 7U; }
  std::uint8_t twist_mask() const noexcept { return static_cast<std::uint8_t>(fuse >> 3); }
};

}  // namespace thing_kin
