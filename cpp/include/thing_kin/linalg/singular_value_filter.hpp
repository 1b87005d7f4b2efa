#pragma once

#include "thing_kin/linalg/svd.hpp"

namespace thing_kin {

/// The singular value filter of Colome & Torras, [M17] (4.12), (4.13): lifts small singular values
/// to at least sigma0 and leaves large ones alone.
class SingularValueFilter {
 public:
  /// Throws InvalidArgument unless sigma0 >= 0, nu >= 0 and the filter is increasing, which it is
  /// iff 2 sigma0 (2 s + nu) <= (s^2 + nu s + 2)^2 at s = max(0, (sqrt(24 - 3 nu^2) - 3 nu)/6)
  /// (s = 0 from nu = sqrt 2 on).
  SingularValueFilter(double sigma0, double nu);

  double sigma0() const { return sigma0_; }
  double nu() const { return nu_; }

  /// h(s) of (4.12).
  double operator()(double s) const;

  /// Filters the singular values of a decomposition in place; its rank becomes full if sigma0 > 0.
  void apply(Svd& svd) const noexcept;

  bool operator==(const SingularValueFilter&) const = default;

 private:
  double sigma0_;
  double nu_;
};

/// The filtered matrix, [M17] (4.13).
SmallMatrix filter_singular_values(const SmallMatrix& A,
                                   const SingularValueFilter& filter) noexcept;

}  // namespace thing_kin
