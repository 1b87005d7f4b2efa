#pragma once

#include <array>
#include <cstdint>

#include "thing_kin/linalg/regularized_rows.hpp"
#include "thing_kin/linalg/working_set.hpp"

namespace thing_kin {

/// The most interval rows a hierarchy may have, all levels together.
inline constexpr int kMaxIntervalRows = 64;

/// Least squares in strict order within bounds: Kanoun, Lamiraux & Wieber (2011), Escande, Mansard
/// & Wieber (2014). Each level is solved as well as the levels before it allow, and no later one
/// changes what it has reached.
///
///   qp.begin(lower, upper, guess);  // the box, which always holds
///   qp.keep(C, l, u);               // a level: l <= C x <= u, or as near to that as can be
///   qp.minimize(A, b, {damping});   // a level: least |A x - b|^2
///   qp.nearest_to(z);               // the last: least |x - z|^2
///   qp.finish();
///
/// A primal active set in the null space of the levels above: at any time x satisfies the box and
/// keeps what the levels above have reached, so that the iteration limit costs optimality only.
class HierarchicalQp {
 public:
  /// lower <= upper, infinities allowed. Starts as near to `guess` as the box allows.
  void begin(const JointVector& lower, const JointVector& upper, const JointVector& guess) noexcept;

  void keep(const SmallMatrix& C, const SmallVector& lower, const SmallVector& upper) noexcept;
  void minimize(const SmallMatrix& A, const SmallVector& b,
                const Regularization& regularization) noexcept;
  void nearest_to(const JointVector& z) noexcept;

  /// Puts what is at a bound exactly there. No level may follow.
  void finish() noexcept;

  const JointVector& x() const { return x_; }
  int free() const { return static_cast<int>(Z_.cols()); }
  int iterations() const { return iterations_; }
  bool converged() const { return converged_; }

 private:
  /// Held: in the working set. Fixed: the levels above can't do without it.
  enum class State : std::uint8_t { kInactive, kHeld, kFixed };

  /// A level: rows that should be in [lower, upper]. `equalities`: all bounds are equal.
  struct Level {
    SmallMatrix K;
    SmallVector lower, upper;
    bool equalities = true;
    bool orthonormal = false;  // K = Z^T
    double scale = 0.0;        // |K|
  };

  /// What a level misses at x.
  struct Residual {
    SmallVector all;     // of each row, 0 within its interval
    SmallMatrix rows;    // those that miss, unless the level has equalities
    SmallVector missed;  // by how much
    const SmallMatrix& matrix(const Level& level) const {
      return level.equalities ? level.K : rows;
    }
  };

  int constraints() const { return static_cast<int>(x_.size()) + count_; }
  double value(int row) const;
  double bound(int row, int side) const;
  double slope(int row, const JointVector& d) const;
  void along_basis(int row, SmallVector& along) const;
  void hold(const WorkingSet::Entry& entry, double least);

  void warm_start();
  void solve(Level& level, Residual& residual) noexcept;
  void miss(const Level& level, Residual& residual) const;
  bool descend(const Level& level, const Residual& residual);
  int first_block(const JointVector& d, double& alpha) const;
  double tolerance(const Level& level, const Residual& residual) const;
  double pull_of(int i) const;
  bool drop_one(const Level& level, const Residual& residual, bool cautious);
  void leave(const Level& level, const Residual& residual, const RegularizedRows* rows);
  void remember(const Level& level, const Residual& residual);

  JointVector lower_, upper_, x_;
  SmallMatrix Z_;  // orthonormal: what the levels so far leave free, but for bounds
  WorkingSet working_;
  SmallVector mu_;  // of the working set, at the end of a level
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxDof, kMaxIntervalRows>
      rows_;  // of unit length, a column each
  std::array<double, kMaxIntervalRows> row_lower_, row_upper_;
  int count_ = 0;
  std::array<State, kMaxDof + kMaxIntervalRows> state_;
  std::array<WorkingSet::Entry, kMaxDof> kept_;  // what the next level begins with
  int kept_count_ = 0;
  int iterations_ = 0;
  bool converged_ = true;
};

}  // namespace thing_kin
