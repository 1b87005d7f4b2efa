#pragma once

#include <vector>

namespace thing_kin {

/// A convex quadratic program over a chain of stages with unknowns p_k of `size` numbers each,
///
///     sum_k p_k^T H_k p_k / 2 + g_k^T p_k + p_k^T E_k p_{k+1} + sum_i rho_i max(0, -d_i),
///     d_i = a_i^T p_k + b_i^T p_{k+1} + c_i,
///
/// whose constraints d_i >= 0 are kept where they can be, and cost rho_i a unit where not (exact
/// penalty: there is always a solution). Primal-dual interior point with Mehrotra's corrector; its
/// matrices are block tridiagonal, so that the cost is linear in stages and rows.
///
/// Nothing allocates after reserve() while its numbers are not exceeded. Not in the theses.
class StagewiseQp {
 public:
  static constexpr int kMaxIterations = 60;

  /// size in [1, kMaxDof].
  explicit StagewiseQp(int size);

  void reserve(int stages, int rows);

  /// Everything zero, no rows.
  void reset(int stages);

  int size() const { return m_; }
  int stages() const { return stages_; }
  int rows() const { return static_cast<int>(rows_.size()); }

  /// H, g and E of a stage: (m, m) in column order, (m), and (m, m): rows belong to stage k,
  /// columns to stage k + 1. H is symmetric.
  double* block(int k) { return H_.data() + k * m_ * m_; }
  double* g(int k) { return g_.data() + k * m_; }
  double* coupling(int k) { return E_.data() + k * m_ * m_; }
  const double* g(int k) const { return g_.data() + k * m_; }

  /// A row of one stage, or of stages k and k + 1; a and b are to be filled in by the caller:
  /// both are zero now, and b follows a.
  double* add_row(int stage, double c, double rho);

  /// Whether H with `damping` on its diagonal is positive definite.
  bool is_convex(double damping) noexcept;

  /// False if it broke down, which takes numbers that are not finite or a problem that is not
  /// convex. mu: complementarity to begin with, about the size of multiplier times slack.
  bool solve(double damping, double mu) noexcept;

  const double* p(int k) const { return p_.data() + k * m_; }

  /// Of row i, in [0, rho_i].
  double multiplier(int i) const { return rows_[static_cast<std::size_t>(i)].z; }

  /// The value at p = 0 less that at the solution, without the damping; at least 0 but for
  /// rounding.
  double decrease() const { return decrease_; }

  /// Sum of max(0, -d_i) at p = 0 and at the solution.
  double violation_before() const { return violation_before_; }
  double violation_after() const { return violation_after_; }

  int iterations() const { return iterations_; }

 private:
  struct Row {
    int stage;
    double c, rho;
    double w, s, z;       ///< d + s, elastic part, multiplier
    double dw, ds, dz;    ///< their steps
    double r1, r2, D, d;  ///< right-hand sides, weight, a p + b p + c
  };

  template <int M>
  bool solve_sized(double damping, double mu) noexcept;
  template <int M>
  void begin(double mu) noexcept;
  template <int M>
  void values(const std::vector<double>& p) noexcept;
  template <int M>
  void assemble(double damping) noexcept;
  template <int M>
  bool factor() noexcept;
  template <int M>
  void direction() noexcept;
  template <int M>
  double dual_residual() noexcept;
  template <int M>
  void finish() noexcept;
  double longest_step() const noexcept;
  double gap() const noexcept;

  int m_;
  int stages_ = 0;
  std::vector<double> H_, g_, E_;    // the problem
  std::vector<double> S_, W_;        // factor: Cholesky of diagonal blocks, couplings
  std::vector<double> p_, dp_, rd_;  // iterate, step, dual residual
  std::vector<Row> rows_;
  std::vector<double> coefficients_;  // a and b of each row
  double damping_ = 0.0;
  double decrease_ = 0.0, violation_before_ = 0.0, violation_after_ = 0.0;
  int iterations_ = 0;
};

}  // namespace thing_kin
