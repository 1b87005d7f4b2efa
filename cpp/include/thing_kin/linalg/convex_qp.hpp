#pragma once

#include <array>
#include <cstdint>

#include "thing_kin/core/types.hpp"

namespace thing_kin {

/// Linear forms, a column each.
using FormsView = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// A strictly convex quadratic program
///
///     minimize  x^T H x/2 + g^T x   subject to   lower_i <= a_i . x <= upper_i
///
/// by the dual active set of Goldfarb & Idnani (1983): it starts at the free minimum and takes in
/// the most violated side at a time, so that few active sides cost few steps and no feasible start
/// is needed. At most kMaxDof variables, any number of forms; nothing is allocated.
class ConvexQp {
 public:
  enum class Status : std::uint8_t {
    kOptimal,
    kInfeasible,  ///< no x keeps all sides; x is the last dual iterate
    kNotConvex,   ///< H is not positive definite: nothing was done
    kIterations,  ///< the limit was reached, by cycling in rounding errors
  };

  /// A form at one of its sides in the solution: H x + g = sum_i multiplier_i a_i.
  struct Active {
    int form;
    double multiplier;  ///< at least 0 at the lower side, at most 0 at the upper one
  };

  /// H: (k, k), its lower triangle is read. forms: (k, m); lower <= upper, infinities allowed,
  /// equal for an equality.
  Status minimize(const SmallMatrix& H, const SmallVector& g, const FormsView& forms,
                  const double* lower, const double* upper) noexcept;

  const SmallVector& x() const { return x_; }
  int active() const { return active_; }
  Active operator[](int i) const;

  /// Whether the solution is at a side of this form.
  bool holds(int form) const noexcept;
  int iterations() const { return iterations_; }

 private:
  struct Side {
    int form;
    double sign;  ///< 1: lower, -1: upper
    bool equality;
  };

  bool begin(const SmallMatrix& H, const SmallVector& g) noexcept;
  double violation(const FormsView& forms, const double* lower, const double* upper,
                   Side& side) const noexcept;
  Status take_in(const FormsView& forms, const Side& side, double short_of) noexcept;
  void append(const Side& side, double multiplier) noexcept;
  void drop(int i) noexcept;

  SmallMatrix J_;  // H^-1 = J J^T; the first active() columns span H^-1 times the active forms
  SmallMatrix R_;  // J^T [active forms] = [R; 0], upper triangular
  SmallVector x_, d_, u_;
  std::array<Side, kMaxDof> sides_{};
  int active_ = 0;
  int iterations_ = 0;
  int most_ = 0;
  double slack_ = 0.0;  // of the sides, as a fraction
};

}  // namespace thing_kin
