#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace thing_kin {

/// Which entries of a state or of a measurement are angles: the one place where they are wrapped.
/// Everything else is a plain number. A planar pose (x, y, theta) whose covariance is in world axes
/// is such a space, with its third entry an angle; differences of angles are in (-pi, pi].
class AngleSet {
 public:
  AngleSet() = default;

  /// Throws InvalidArgument("angles", ...) unless the indices are different and below n.
  AngleSet(std::span<const int> indices, int n);

  bool empty() const noexcept { return mask_ == 0; }
  bool operator==(const AngleSet&) const = default;
  std::vector<int> indices() const;

  /// v <- the same point, or the same difference, with angles in (-pi, pi].
  void wrap(double* v) const noexcept {
    if (mask_ != 0) {
      wrap_angles(v);
    }
  }

  /// out <- a - b, of n entries; out may be either.
  void difference(const double* a, const double* b, double* out, int n) const noexcept {
    for (int i = 0; i < n; ++i) {
      out[i] = a[i] - b[i];
    }
    wrap(out);
  }

  /// out <- x moved by the difference d, of n entries; out may be either.
  void retract(const double* x, const double* d, double* out, int n) const noexcept {
    for (int i = 0; i < n; ++i) {
      out[i] = x[i] + d[i];
    }
    wrap(out);
  }

 private:
  void wrap_angles(double* v) const noexcept;

  std::uint32_t mask_ = 0;
};

}  // namespace thing_kin
