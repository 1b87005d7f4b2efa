#pragma once

#include <array>

#include "thing_kin/core/types.hpp"

namespace thing_kin {

/// Linear constraints that hold with equality, and what they leave free: an orthonormal basis
/// Q = [Y N] of a space, Y spanned by the constraints' normals in it, N orthogonal to all of them.
/// Adding is a Householder reflection, dropping a few Givens rotations.
class WorkingSet {
 public:
  /// `side` +1: at its upper bound, -1: at its lower one.
  struct Entry {
    int row;
    int side;
  };

  /// Nothing held; everything in the span of the orthonormal Z is free.
  void reset(const SmallMatrix& Z) noexcept;

  int size() const { return size_; }
  int free() const { return static_cast<int>(q_.cols()) - size_; }
  const Entry& operator[](int i) const { return entries_[static_cast<std::size_t>(i)]; }
  const SmallMatrix& basis() const { return q_; }  ///< Q, the first size() columns are Y
  auto free_basis() const { return q_.rightCols(free()); }

  /// Holds a further constraint whose normal c has Q^T c = `along`. False, and nothing happens, if
  /// what is free hardly moves it (less than `least` of it is left).
  bool add(Entry entry, const SmallVector& along, double least) noexcept;

  void drop(int i) noexcept;

  /// The mu with g + sum mu_i c_i = 0 in the span of Y, for the gradient's Q^T g.
  void multipliers(const SmallVector& gradient_along, SmallVector& mu) const noexcept;

 private:
  void reflect_columns(const SmallVector& v) noexcept;

  SmallMatrix q_;
  SmallMatrix r_;  // Y^T [c_1 ... c_size], upper triangular
  int size_ = 0;
  std::array<Entry, kMaxDof> entries_;
};

}  // namespace thing_kin
