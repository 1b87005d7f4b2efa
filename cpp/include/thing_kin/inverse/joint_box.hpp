#pragma once

#include <array>

#include "thing_kin/model/chain.hpp"

namespace thing_kin {

/// Where the joints may be, and how they move in it: joint limits, or these and a bound on the
/// way from a seed.
class JointBox {
 public:
  explicit JointBox(const Chain& chain) noexcept;

  /// What of the box is within max_step (one a joint) of seed, which is in the box.
  void keep_near(const JointVector& seed, const JointVector& max_step) noexcept;

  /// What of joint j's range is within [lower, upper]; crossed where nothing is.
  void narrow(Eigen::Index j, double lower, double upper) noexcept;

  double lower(Eigen::Index j) const { return lower_[j]; }
  double upper(Eigen::Index j) const { return upper_[j]; }

  /// Whether joint j turns freely or has a whole turn between its limits: then no limit stops it,
  /// since it can go on at the other end, at the same pose.
  bool is_endless(Eigen::Index j) const { return endless_[static_cast<std::size_t>(j)]; }
  bool is_rotary(Eigen::Index j) const { return rotary_[static_cast<std::size_t>(j)]; }

  /// The nearest place to x for joint j; an endless joint goes on at the other end.
  double inside(Eigen::Index j, double x) const noexcept;

  bool contains(const JointVector& q) const noexcept;

  /// Moves each endless joint by whole turns to the image nearest to `seed`, which is in the
  /// box.
  void wind_towards(const JointVector& seed, JointVector& q) const noexcept;

 private:
  JointVector lower_, upper_;
  std::array<bool, kMaxDof> endless_{};
  std::array<bool, kMaxDof> rotary_{};
};

}  // namespace thing_kin
